// SPDX-License-Identifier: MIT
#include "hosts/shading.h"

#include <cstddef>

namespace lodestar::hosts {

std::string shadingText(const LodestarApi& api, std::int32_t profile) {
    LodestarDialect dialect{};
    dialect.struct_size = sizeof dialect;
    dialect.version = 330;
    dialect.profile = profile;
    dialect.without_version_line = 1;
    std::string whole;
    for (const char* file : {"plugin/lighting.glsl", "lodestar/display.glsl"}) {
        std::size_t size = 0;
        api.glsl_text(file, &dialect, nullptr, &size);
        std::string text(size, '\0');
        api.glsl_text(file, &dialect, text.data(), &size);
        text.resize(size > 0 ? size - 1 : 0);
        whole += text;
    }
    return whole;
}

std::vector<LodestarUniform> uniforms(const LodestarApi& api) {
    std::vector<LodestarUniform> all;
    LodestarUniform one{};
    one.struct_size = sizeof one;
    for (std::uint32_t i = 0; api.uniform_info(i, &one) == LODESTAR_OK; ++i) {
        all.push_back(one);
    }
    return all;
}

std::vector<unsigned char> uniformData(const LodestarApi& api, LodestarContext* context,
                                       LodestarPlan plan) {
    std::size_t size = 0;
    api.plan_uniforms(context, plan, nullptr, &size);
    std::vector<unsigned char> data(size);
    if (api.plan_uniforms(context, plan, data.data(), &size) != LODESTAR_OK) {
        data.clear();
    }
    return data;
}

} // namespace lodestar::hosts
