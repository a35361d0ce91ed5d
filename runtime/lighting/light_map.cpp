// SPDX-License-Identifier: MIT
#include "lighting/light_map.h"

#include <utility>

namespace lodestar::lighting {

LightMap::LightMap(DayLight day, const RsrmLayout& layout, std::shared_ptr<RsrmKernels> kernels)
    : day_(std::move(day)), layout_(layout), kernels_(std::move(kernels)), keys_(day_.keys.size()) {
}

LightMap::Content LightMap::contentOf(const DayMoment& moment) {
    return {moment.keys.from, moment.keys.to, moment.keys.t, moment.visibility};
}

const LightMap::Key& LightMap::key(std::size_t index) {
    std::optional<Key>& key = keys_[index];
    if (!key) {
        const auto kernel = kernels_->get(layout_, day_.kind);
        key =
            Key{kernel->bake(keyRadiance(day_, index, kernel->zones())), keyGradient(day_, index)};
    }
    return *key;
}

LightMap::Blend LightMap::blend(const Content& content) {
    const Key& from = key(content.from);
    const Key& to = key(content.to);
    return {encode(layout_, blended(from.bake, to.bake, content.t, content.factor)),
            blended(from.gradient, to.gradient, content.t, content.factor)};
}

} // namespace lodestar::lighting
