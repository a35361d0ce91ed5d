// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lighting/environment.h"

namespace lodestar::lighting {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMaxRadiance = 1e9;

using Words = std::vector<std::string_view>;

Words split(std::string_view text, char separator) {
    Words words;
    for (;;) {
        const std::size_t end = text.find(separator);
        words.push_back(text.substr(0, end));
        if (end == std::string_view::npos) {
            return words;
        }
        text.remove_prefix(end + 1);
    }
}

core::Error usage(std::string what, std::string_view where = {}) {
    return {core::ErrorCode::Usage, std::move(what), {}, std::string(where)};
}

core::Result<double> parseNumber(std::string_view word) {
    double value = 0.0;
    const char* begin = word.data() + (word.starts_with('+') && word.size() > 1 ? 1 : 0);
    const char* end = word.data() + word.size();
    const auto [rest, status] = std::from_chars(begin, end, value);
    if (word.empty()) {
        return usage("a number is missing");
    }
    if (status != std::errc() || rest != end || !std::isfinite(value)) {
        return usage("a word is not a finite number", word);
    }
    return value;
}

core::Result<double> parseRadianceNumber(std::string_view word) {
    auto value = parseNumber(word);
    if (value && !(*value >= 0.0 && *value <= kMaxRadiance)) {
        return usage("a radiance is outside [0, 1e9]", word);
    }
    return value;
}

core::Result<glm::dvec3> parseVector(const Words& words,
                                     core::Result<double> (*parse)(std::string_view)) {
    glm::dvec3 vector(0.0);
    for (int c = 0; c < 3; ++c) {
        auto value = parse(words[static_cast<std::size_t>(c)]);
        if (!value) {
            return value.error();
        }
        vector[c] = *value;
    }
    return vector;
}

/// One number (grey), or three separated by slashes.
core::Result<glm::dvec3> parseRadiance(std::string_view text) {
    const Words words = split(text, '/');
    if (words.size() == 1) {
        auto grey = parseRadianceNumber(words[0]);
        if (!grey) {
            return grey.error();
        }
        return glm::dvec3(*grey);
    }
    if (words.size() != 3) {
        return usage("a radiance is one number or R/G/B", text);
    }
    return parseVector(words, parseRadianceNumber);
}

core::Result<AnalyticEnvironment> parseConstant(std::string_view text) {
    const Words words = split(text, ',');
    if (words.size() != 3) {
        return usage("a constant environment is constant:R,G,B", text);
    }
    auto colour = parseVector(words, parseRadianceNumber);
    if (!colour) {
        return colour.error();
    }
    return AnalyticEnvironment(ConstantEnvironment{*colour});
}

core::Result<AnalyticEnvironment> parseGradient(std::string_view text) {
    const Words words = split(text, ',');
    if (words.size() != 2) {
        return usage("a gradient environment is gradient:DOWN,UP, each one number or R/G/B", text);
    }
    auto down = parseRadiance(words[0]);
    if (!down) {
        return down.error();
    }
    auto up = parseRadiance(words[1]);
    if (!up) {
        return up.error();
    }
    return AnalyticEnvironment(GradientEnvironment{*down, *up});
}

core::Result<AnalyticEnvironment> parseDisc(std::string_view text) {
    const Words words = split(text, ',');
    if (words.size() != 5 && words.size() != 6) {
        return usage("a disc environment is disc:X,Y,Z,DEGREES,INSIDE[,OUTSIDE]", text);
    }
    auto axis = parseVector(words, parseNumber);
    if (!axis) {
        return axis.error();
    }
    const double longest = std::max({std::abs(axis->x), std::abs(axis->y), std::abs(axis->z)});
    if (!(longest > 0.0)) {
        return usage("a disc's axis is the zero vector", text);
    }
    auto degrees = parseNumber(words[3]);
    if (!degrees) {
        return degrees.error();
    }
    if (!(*degrees > 0.0 && *degrees <= 180.0)) {
        return usage("a disc's angular radius is outside (0, 180] degrees", words[3]);
    }
    auto inside = parseRadiance(words[4]);
    if (!inside) {
        return inside.error();
    }
    auto outside = words.size() == 6 ? parseRadiance(words[5]) : glm::dvec3(0.0);
    if (!outside) {
        return outside.error();
    }
    return AnalyticEnvironment(DiscEnvironment{glm::normalize(*axis / longest),
                                               *degrees * kPi / 180.0, *inside, *outside});
}

core::Result<AnalyticEnvironment> parseFaces(std::string_view text) {
    const Words words = split(text, ';');
    if (words.size() != 6) {
        return usage("a faces environment is faces: and six colours in GL's order, separated by ;",
                     text);
    }
    FacesEnvironment faces;
    for (std::size_t i = 0; i < 6; ++i) {
        const Words commas = split(words[i], ',');
        auto colour =
            commas.size() == 3 ? parseVector(commas, parseRadianceNumber) : parseRadiance(words[i]);
        if (!colour) {
            return colour.error();
        }
        faces.radiance[i] = *colour;
    }
    return AnalyticEnvironment(faces);
}

struct Kind {
    std::string_view prefix;
    core::Result<AnalyticEnvironment> (*parse)(std::string_view);
};

constexpr Kind kKinds[] = {{"constant:", parseConstant},
                           {"gradient:", parseGradient},
                           {"disc:", parseDisc},
                           {"faces:", parseFaces}};

const Kind* kindOf(std::string_view text) {
    for (const Kind& kind : kKinds) {
        if (text.starts_with(kind.prefix)) {
            return &kind;
        }
    }
    return nullptr;
}

} // namespace

bool isAnalytic(std::string_view text) {
    return kindOf(text) != nullptr;
}

core::Result<AnalyticEnvironment> parseAnalytic(std::string_view text) {
    const Kind* kind = kindOf(text);
    if (kind == nullptr) {
        return usage("an analytic environment starts with constant:, gradient:, disc: or faces:",
                     text);
    }
    return kind->parse(text.substr(kind->prefix.size()));
}

} // namespace lodestar::lighting
