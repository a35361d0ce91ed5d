// SPDX-License-Identifier: MIT
//
// Reads rendered pictures and compares them.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "io/file.h"
#include "io/image_file.h"

namespace lodestar::testing {

/// The picture at a path with 4 channels; empty (and a failure) if it cannot be read.
inline core::Image readPicture(const std::string& path) {
    auto bytes = io::readFile(path);
    if (!bytes) {
        ADD_FAILURE() << bytes.error().message();
        return {};
    }
    auto decoded = io::decodeImage(*bytes, 4);
    if (!decoded) {
        ADD_FAILURE() << path << ": " << decoded.error().message();
        return {};
    }
    return std::move(decoded->image);
}

/// How two pictures differ, over rgb.
struct Difference {
    double largest = 0.0;
    double mean = 0.0;
    double failingFraction = 0.0; ///< pixels with a channel beyond the tolerance
};

inline Difference compare(const core::Image& a, const core::Image& b, double tolerance) {
    Difference difference;
    if (a.width() != b.width() || a.height() != b.height() || a.empty()) {
        ADD_FAILURE() << "pictures of different sizes, or none";
        return {1e30, 1e30, 1.0};
    }
    std::size_t failing = 0;
    for (std::size_t i = 0; i < a.pixels().size(); i += 4) {
        double pixel = 0.0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double d = std::abs(static_cast<double>(a.pixels()[i + c]) -
                                      static_cast<double>(b.pixels()[i + c]));
            pixel = std::max(pixel, d);
            difference.mean += d;
        }
        difference.largest = std::max(difference.largest, pixel);
        failing += pixel > tolerance ? 1 : 0;
    }
    const double pixels = static_cast<double>(a.pixels().size()) / 4.0;
    difference.mean /= 3.0 * pixels;
    difference.failingFraction = static_cast<double>(failing) / pixels;
    return difference;
}

} // namespace lodestar::testing
