// SPDX-License-Identifier: MIT
#include "app/command.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

#include <unistd.h>

namespace lodestar::app {
namespace {

std::optional<double> parseNumber(std::string_view text) {
    if (!text.empty() && text.front() == '+') {
        text.remove_prefix(1);
    }
    double value = 0.0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc{} && stop == text.data() + text.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string quoted(std::string_view text) {
    return std::string(1, '\'').append(text).append(1, '\'');
}

} // namespace

int fail(const core::Error& error) {
    std::fprintf(stderr, "lodestar: %s\n", error.message().c_str());
    return static_cast<int>(error.code);
}

void warn(const core::Tally& warnings, const std::string& file) {
    for (const auto& [rule, count] : warnings.counts()) {
        std::fprintf(stderr, "lodestar: warning: %s: %s (%llu times)\n", file.c_str(), rule.c_str(),
                     static_cast<unsigned long long>(count));
    }
}

void progress(const std::string& what, std::size_t done, std::size_t of) {
    if (isatty(STDERR_FILENO) != 0) {
        std::fprintf(stderr, "\r%s %zu of %zu\033[K", what.c_str(), done, of);
    }
}

void endProgress() {
    if (isatty(STDERR_FILENO) != 0) {
        std::fprintf(stderr, "\r\033[K");
    }
}

core::Error usage(std::string what, std::string where) {
    return {core::ErrorCode::Usage, std::move(what), {}, std::move(where)};
}

core::Result<std::vector<double>> parseNumbers(std::string_view text, std::size_t count,
                                               const std::string& option) {
    std::vector<double> numbers;
    std::string_view rest = text;
    while (true) {
        const std::size_t comma = rest.find(',');
        const std::optional<double> number = parseNumber(rest.substr(0, comma));
        if (!number) {
            break;
        }
        numbers.push_back(*number);
        if (comma == std::string_view::npos) {
            if (numbers.size() == count) {
                return numbers;
            }
            break;
        }
        rest.remove_prefix(comma + 1);
    }
    return usage(quoted(text) + " is not " + std::to_string(count) +
                     " finite numbers separated by commas",
                 option);
}

core::Result<glm::dvec3> parseVector(std::string_view text, const std::string& option) {
    auto numbers = parseNumbers(text, 3, option);
    if (!numbers) {
        return numbers.error();
    }
    return glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

core::Result<double> parseExponent(std::string_view text, const std::string& option) {
    if (text == "inf" || text == "mirror") {
        return std::numeric_limits<double>::infinity();
    }
    const std::optional<double> value = parseNumber(text);
    if (!value || *value < 0.0) {
        return usage(quoted(text) + " is not an exponent: a number from 0, or inf", option);
    }
    return *value;
}

core::Result<glm::dvec3> parseAxis(std::string_view text, const std::string& option) {
    const auto axis = parseVector(text, option);
    if (!axis) {
        return axis.error();
    }
    const double length = glm::length(*axis);
    if (!(length > 1e-12) || !std::isfinite(length)) {
        return usage("an axis has a length", option);
    }
    return *axis / length;
}

core::Result<std::vector<double>> parseExponents(std::string_view text, const std::string& option) {
    constexpr double kMost = 1e7;
    std::vector<double> exponents;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        const auto exponent = parseExponent(text.substr(from, comma - from), option);
        if (!exponent) {
            return exponent.error();
        }
        if (*exponent > kMost) {
            return usage("an exponent of a list lies in [0, 1e7]; a mirror has none", option);
        }
        exponents.push_back(*exponent);
        from = comma + 1;
    }
    return exponents;
}

} // namespace lodestar::app
