// SPDX-License-Identifier: MIT
#include "lighting/rsrm.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include <glm/common.hpp>

#include "core/contract.h"
#include "core/half.h"

#include "lodestar/rsrm.glsl"

namespace lodestar::lighting {

namespace {

/// A row's least scale: a black row has one too.
constexpr float kLeastScale = 1e-30f;
/// How far scales follow the peaks: chosen on a sun, a glow and a sky (docs/derivations/rsrm.md).
constexpr float kScalePower = 0.7f;

/// Stored values before rounding: [row][channel][column].
struct Planes {
    std::size_t columns;
    std::vector<float> values;

    Planes(std::size_t rows, std::size_t width) : columns(width), values(rows * 3 * width) {}
    [[nodiscard]] std::size_t rowSize() const { return 3 * columns; }
    [[nodiscard]] float* row(std::size_t k) { return values.data() + k * rowSize(); }
    [[nodiscard]] const float* row(std::size_t k) const { return values.data() + k * rowSize(); }
};

float largest(const float* values, std::size_t count) {
    return count == 0 ? 0.0f : *std::max_element(values, values + count);
}

/// Least squares of the hat functions of rows 0 to n - 1 to samples at places: the normal equations
/// are tridiagonal, and the same for every column.
class HatFit {
public:
    HatFit(const std::vector<double>& places, std::size_t rows)
        : places_(places), upper_(rows), pivot_(rows) {
        std::vector<double> diagonal(rows);
        std::vector<double> beside(rows);
        for (const double place : places) {
            const auto [k, t] = split(place, rows);
            diagonal[k] += (1.0 - t) * (1.0 - t);
            diagonal[k + 1] += t * t;
            beside[k] += t * (1.0 - t);
        }
        for (std::size_t k = 0; k < rows; ++k) {
            const double below = k == 0 ? 0.0 : beside[k - 1];
            pivot_[k] = diagonal[k] - (k == 0 ? 0.0 : below * upper_[k - 1]);
            upper_[k] = beside[k] / pivot_[k];
        }
        beside_ = beside;
    }

    /// @param samples [place][value]  @param fitted out, [row][value]
    void solve(const std::vector<float>& samples, Planes& fitted) const {
        const std::size_t rows = pivot_.size();
        const std::size_t width = fitted.rowSize();
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const auto [k, t] = split(places_[i], rows);
            add(fitted.row(k), samples.data() + i * width, static_cast<float>(1.0 - t), width);
            add(fitted.row(k + 1), samples.data() + i * width, static_cast<float>(t), width);
        }
        for (std::size_t k = 0; k < rows; ++k) {
            if (k > 0) {
                add(fitted.row(k), fitted.row(k - 1), static_cast<float>(-beside_[k - 1]), width);
            }
            float* row = fitted.row(k);
            const auto factor = static_cast<float>(1.0 / pivot_[k]);
            for (std::size_t i = 0; i < width; ++i) {
                row[i] *= factor;
            }
        }
        for (std::size_t k = rows - 1; k > 0; --k) {
            add(fitted.row(k - 1), fitted.row(k), static_cast<float>(-upper_[k - 1]), width);
        }
    }

private:
    static std::pair<std::size_t, double> split(double place, std::size_t rows) {
        const std::size_t k = std::min(static_cast<std::size_t>(place), rows - 2);
        return {k, place - static_cast<double>(k)};
    }
    static void add(float* out, const float* values, float factor, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            out[i] += factor * values[i];
        }
    }

    const std::vector<double>& places_;
    std::vector<double> beside_;
    std::vector<double> upper_;
    std::vector<double> pivot_;
};

/// Scales of the rows from the bakes at their exponents: the largest channel anywhere, pulled
/// 0.3 of the way (in the logarithm) to the greatest. Between rows a lobe's skirt is then off by
/// less than with the peaks alone; the first rows lose half a bit (RSRM-9).
std::vector<float> scaleLogs(const RsrmLayout& layout, const RsrmBake& bake) {
    const auto rows = static_cast<std::size_t>(layout.rows);
    const std::size_t step = (bake.exponents.size() - 1) / (rows - 1);
    std::vector<float> logs(rows, 0.0f);
    for (std::size_t k = 0; k < rows; ++k) {
        logs[k] =
            std::log2(std::max(largest(bake.value(k * step, 0), 3 * bake.columns), kLeastScale));
    }
    const float last = *std::max_element(logs.begin(), logs.end());
    for (float& log : logs) {
        log = last + kScalePower * (log - last);
    }
    return logs;
}

/// sqrt(value / scale) fitted over the rows (RSRM-9); where a fitted value is above 1, all scales
/// grow so that none is.
Planes fittedPlanes(const RsrmLayout& layout, const RsrmBake& bake, std::vector<float>& logScales) {
    const auto rows = static_cast<std::size_t>(layout.rows);
    const std::vector<double> places = fitPlaces(layout);
    if (layout.rowScales) {
        logScales = scaleLogs(layout, bake);
    }
    const std::size_t width = 3 * bake.columns;
    std::vector<float> samples(bake.planes.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto k = std::min(static_cast<std::size_t>(places[i]), rows - 2);
        const auto t = static_cast<float>(places[i] - static_cast<double>(k));
        const float scale = 1.0f / shader::lodestar_rsrmRowScale(logScales[k], logScales[k + 1], t);
        for (std::size_t c = 0; c < width; ++c) {
            samples[i * width + c] = std::sqrt(std::max(bake.planes[i * width + c], 0.0f) * scale);
        }
    }
    Planes planes(rows, bake.columns);
    HatFit(places, rows).solve(samples, planes);
    const float most = largest(planes.values.data(), planes.values.size());
    const float grown = layout.rowScales && most > 1.0f ? most : 1.0f;
    for (float& value : planes.values) {
        value = std::max(value, 0.0f) / grown;
    }
    for (float& log : logScales) {
        log += 2.0f * std::log2(grown);
    }
    return planes;
}

/// The rows' own values over one scale.
Planes plainPlanes(const RsrmLayout& layout, const RsrmBake& bake, std::vector<float>& logScales) {
    Planes planes(static_cast<std::size_t>(layout.rows), bake.columns);
    const float scale = std::max(largest(bake.planes.data(), bake.planes.size()), kLeastScale);
    for (std::size_t i = 0; i < planes.values.size(); ++i) {
        planes.values[i] = bake.planes[i] / scale;
    }
    std::fill(logScales.begin(), logScales.end(), std::log2(scale));
    return planes;
}

std::uint32_t quantised(float value, float steps) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * steps));
}

template <class T>
void append(std::vector<std::uint8_t>& bytes, const T& value) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof value);
    std::memcpy(bytes.data() + at, &value, sizeof value);
}

void appendTexel(std::vector<std::uint8_t>& bytes, RsrmEncoding encoding, const glm::vec3& rgb) {
    switch (encoding) {
    case RsrmEncoding::Unorm8:
        for (int c = 0; c < 3; ++c) {
            bytes.push_back(static_cast<std::uint8_t>(quantised(rgb[c], 255.0f)));
        }
        bytes.push_back(255);
        break;
    case RsrmEncoding::Unorm10:
        append(bytes, quantised(rgb.r, 1023.0f) | quantised(rgb.g, 1023.0f) << 10 |
                          quantised(rgb.b, 1023.0f) << 20 | 3u << 30);
        break;
    case RsrmEncoding::Half:
        for (int c = 0; c < 3; ++c) {
            append(bytes, core::halfFromFloat(rgb[c]));
        }
        append(bytes, core::halfFromFloat(1.0f));
        break;
    case RsrmEncoding::Float:
        append(bytes, glm::vec4(rgb, 1.0f));
        break;
    }
}

} // namespace

RsrmTexels encode(const RsrmLayout& layout, const RsrmBake& bake, std::vector<glm::vec3> gradient) {
    LODESTAR_EXPECT(bake.exponents == bakedExponents(layout) &&
                        bake.columns == static_cast<std::size_t>(layout.columns),
                    "the bake is of the layout");
    LODESTAR_EXPECT(gradient.size() == bake.columns,
                    "the unfiltered gradient has a value a column");
    const auto rows = static_cast<std::size_t>(layout.rows);
    RsrmTexels texels{layout, {}, std::vector<float>(rows, 0.0f), std::move(gradient)};
    const Planes planes = layout.fitted ? fittedPlanes(layout, bake, texels.logScales)
                                        : plainPlanes(layout, bake, texels.logScales);
    texels.bytes.reserve(texelBytes(layout));
    for (std::size_t k = 0; k < rows; ++k) {
        const float* row = planes.row(k);
        for (std::size_t i = 0; i < bake.columns; ++i) {
            appendTexel(texels.bytes, layout.encoding,
                        {row[i], row[bake.columns + i], row[2 * bake.columns + i]});
        }
    }
    return texels;
}

std::vector<glm::vec3> unfiltered(const RadianceProfile& profile, const RsrmLayout& layout) {
    const std::vector<double> angles = columnAngles(layout.columnMap, layout.columns);
    std::vector<double> edges{0.0};
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
        edges.push_back(0.5 * (angles[i] + angles[i + 1]));
    }
    edges.push_back(std::numbers::pi);
    const std::vector<glm::dvec3> means = ringMeans(profile, edges);
    return {means.begin(), means.end()};
}

glm::vec4 storedTexel(const RsrmTexels& texels, int column, int row) {
    const RsrmLayout& layout = texels.layout;
    LODESTAR_EXPECT(column >= 0 && column < layout.columns && row >= 0 && row < layout.rows,
                    "the texel is in the map");
    const std::size_t each = texelBytes(layout) / (static_cast<std::size_t>(layout.columns) *
                                                   static_cast<std::size_t>(layout.rows));
    const std::uint8_t* bytes =
        texels.bytes.data() +
        each * (static_cast<std::size_t>(row) * static_cast<std::size_t>(layout.columns) +
                static_cast<std::size_t>(column));
    glm::vec4 value(0.0f, 0.0f, 0.0f, 1.0f);
    if (layout.encoding == RsrmEncoding::Unorm8) {
        for (int c = 0; c < 3; ++c) {
            value[c] = static_cast<float>(bytes[c]) / 255.0f;
        }
    } else if (layout.encoding == RsrmEncoding::Unorm10) {
        std::uint32_t packed = 0;
        std::memcpy(&packed, bytes, sizeof packed);
        for (int c = 0; c < 3; ++c) {
            value[c] = static_cast<float>(packed >> (10 * c) & 1023u) / 1023.0f;
        }
    } else if (layout.encoding == RsrmEncoding::Half) {
        std::uint16_t halves[4] = {};
        std::memcpy(halves, bytes, sizeof halves);
        for (int c = 0; c < 3; ++c) {
            value[c] = core::floatFromHalf(halves[c]);
        }
    } else {
        std::memcpy(&value, bytes, sizeof value);
    }
    return value;
}

} // namespace lodestar::lighting

namespace lodestar::shader {

namespace {

/// Texels read as a GPU reads them, bilinear.
struct RsrmCpuHost {
    const lighting::RsrmTexels* texels = nullptr;

#define LODESTAR_HOST_CLASS
#include "lodestar/rsrm.glsl"
#undef LODESTAR_HOST_CLASS

    [[nodiscard]] vec4 lodestar_host_rsrm(float column, float row, int) const {
        const int left = std::min(static_cast<int>(column), texels->layout.columns - 2);
        const float t = column - static_cast<float>(left);
        if (row >= static_cast<float>(texels->layout.rows)) {
            const auto i = static_cast<std::size_t>(left);
            const vec3 radiance = glm::mix(texels->gradient[i], texels->gradient[i + 1], t);
            return {glm::sqrt(radiance), 1.0f};
        }
        const int top = std::min(static_cast<int>(row), texels->layout.rows - 2);
        const float v = row - static_cast<float>(top);
        const auto k = static_cast<std::size_t>(top);
        vec4 value = glm::mix(glm::mix(lighting::storedTexel(*texels, left, top),
                                       lighting::storedTexel(*texels, left + 1, top), t),
                              glm::mix(lighting::storedTexel(*texels, left, top + 1),
                                       lighting::storedTexel(*texels, left + 1, top + 1), t),
                              v);
        value.a = lodestar_rsrmRowScale(texels->logScales[k], texels->logScales[k + 1], v);
        return value;
    }
};

} // namespace

} // namespace lodestar::shader

namespace lodestar::lighting {

glm::vec3 rsrmRadiance(const RsrmTexels& texels, double theta, double exponent) {
    shader::RsrmCpuHost host;
    host.texels = &texels;
    shader::LodestarRsrm map{};
    map.layoutName = texels.layout.columnMap == RsrmColumns::UniformHeight
                         ? shader::LODESTAR_RSRM_PUBLISHED
                         : shader::LODESTAR_RSRM_REFINED;
    map.axis = {0.0f, 0.0f, 1.0f};
    map.columns = static_cast<float>(texels.layout.columns);
    map.rows = static_cast<float>(texels.layout.rows);
    map.leastExponent = static_cast<float>(texels.layout.leastExponent);
    map.greatestExponent = static_cast<float>(texels.layout.greatestExponent);
    const glm::vec3 r(static_cast<float>(std::sin(theta)), 0.0f,
                      static_cast<float>(std::cos(theta)));
    return host.lodestar_rsrm(map, r, static_cast<float>(exponent));
}

} // namespace lodestar::lighting
