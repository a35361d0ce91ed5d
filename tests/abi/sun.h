// SPDX-License-Identifier: MIT
//
// A sun that a host of tests describes.
#pragma once

#include "lodestar/lodestar.h"

namespace lodestar::testing {

/// A sun of one key.
struct Sun {
    LodestarStop stops[2]{};
    LodestarKey key{};
    LodestarLightDesc desc{};

    Sun() { reset(); }
    Sun(const Sun&) = delete; // the description points into it
    Sun& operator=(const Sun&) = delete;
    void reset() {
        stops[0] = {0, {1, 0.9, 0.8}, 10};
        stops[1] = {3, {1, 0.9, 0.8}, 10};
        key = {};
        desc = {};
        key.struct_size = sizeof key;
        key.stops = stops;
        key.stop_count = 2;
        key.hour = 12.0;
        key.tint[0] = key.tint[1] = key.tint[2] = 1.0;
        desc.struct_size = sizeof desc;
        desc.kind = LODESTAR_SUN;
        desc.axis[1] = 2.0;
        desc.key_count = 1;
        desc.key_stride = sizeof key;
        desc.keys = &key;
    }
};

} // namespace lodestar::testing
