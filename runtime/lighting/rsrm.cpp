// SPDX-License-Identifier: MIT
#include "lighting/rsrm.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>

#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>

#include "core/contract.h"
#include "core/half.h"

#define LODESTAR_RSRM_ROWS 1
#include "lodestar/rsrm.glsl"

namespace lodestar::lighting {

namespace {

/// A map's least scale: a black one has one too.
constexpr float kLeastScale = 1e-30f;

float greatest(const RsrmBake& bake) {
    return std::max(*std::max_element(bake.planes.begin(), bake.planes.end()), kLeastScale);
}

/// Stored values before rounding: [row][channel][column].
struct Planes {
    std::size_t columns;
    std::vector<float> values;

    Planes(std::size_t rows, std::size_t width) : columns(width), values(rows * 3 * width) {}
    [[nodiscard]] std::size_t rowSize() const { return 3 * columns; }
    [[nodiscard]] float* row(std::size_t k) { return values.data() + k * rowSize(); }
    [[nodiscard]] const float* row(std::size_t k) const { return values.data() + k * rowSize(); }
};

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

/// sqrt(value) fitted over the rows (RSRM-9).
Planes fittedPlanes(const RsrmLayout& layout, const RsrmBake& bake) {
    const auto rows = static_cast<std::size_t>(layout.rows);
    std::vector<float> samples(bake.planes.size());
    std::transform(bake.planes.begin(), bake.planes.end(), samples.begin(),
                   [](float value) { return std::sqrt(std::max(value, 0.0f)); });
    Planes planes(rows, bake.columns);
    const std::vector<double> places = fitPlaces(layout);
    HatFit(places, rows).solve(samples, planes);
    for (float& value : planes.values) {
        value = std::max(value, 0.0f);
    }
    return planes;
}

/// The rows' own values over one scale.
Planes plainPlanes(const RsrmLayout& layout, const RsrmBake& bake, float& scale) {
    Planes planes(static_cast<std::size_t>(layout.rows), bake.columns);
    scale = greatest(bake);
    for (std::size_t i = 0; i < planes.values.size(); ++i) {
        planes.values[i] = bake.planes[i] / scale;
    }
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
    case RsrmEncoding::SharedExponent:
        append(bytes, glm::packF3x9_E1x5(rgb));
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

glm::vec4 readTexel(RsrmEncoding encoding, const std::uint8_t* bytes) {
    glm::vec4 value(0.0f, 0.0f, 0.0f, 1.0f);
    if (encoding == RsrmEncoding::Unorm8) {
        for (int c = 0; c < 3; ++c) {
            value[c] = static_cast<float>(bytes[c]) / 255.0f;
        }
    } else if (encoding == RsrmEncoding::SharedExponent) {
        std::uint32_t packed = 0;
        std::memcpy(&packed, bytes, sizeof packed);
        value = glm::vec4(glm::unpackF3x9_E1x5(packed), 1.0f);
    } else if (encoding == RsrmEncoding::Half) {
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

/// Angles between the columns of an unfiltered gradient, pole to pole. Found by bisection, always
/// the same: most of the time of an edit if made for each. An array, for what lives on is not the
/// host's memory.
const std::array<double, kGradientColumns + 1>& gradientEdges() {
    static const auto kept = [] {
        const std::vector<double> angles = columnAngles(RsrmColumns::Refined, kGradientColumns);
        std::array<double, kGradientColumns + 1> made{};
        for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
            made[i + 1] = 0.5 * (angles[i] + angles[i + 1]);
        }
        made.back() = std::numbers::pi;
        return made;
    }();
    return kept;
}

} // namespace

RsrmTexels encode(const RsrmLayout& layout, const RsrmBake& bake) {
    LODESTAR_EXPECT(bake.exponents == bakedExponents(layout) &&
                        bake.columns == static_cast<std::size_t>(layout.columns),
                    "the bake is of the layout");
    RsrmTexels texels{layout, {}, 1.0f, bake.lambert};
    const Planes planes =
        layout.fitted ? fittedPlanes(layout, bake) : plainPlanes(layout, bake, texels.scale);
    texels.bytes.reserve(texelBytes(layout));
    for (std::size_t k = 0; k < static_cast<std::size_t>(layout.rows); ++k) {
        const float* row = planes.row(k);
        for (std::size_t i = 0; i < bake.columns; ++i) {
            appendTexel(texels.bytes, layout.encoding,
                        {row[i], row[bake.columns + i], row[2 * bake.columns + i]});
        }
    }
    if (!layout.fitted) { // as published: Lambert's is the row of exponent 1
        const auto row =
            static_cast<int>(std::lround(-firstOctave(layout) * rowsPerOctave(layout)));
        for (int i = 0; i < layout.columns; ++i) {
            texels.lambert.emplace_back(glm::vec3(storedTexel(texels, i, row)) * texels.scale);
        }
    }
    return texels;
}

std::vector<glm::vec3> unfiltered(const RadianceProfile& profile) {
    const std::vector<double> edges(gradientEdges().begin(), gradientEdges().end());
    const std::vector<glm::dvec3> means = ringMeans(profile, edges);
    return {means.begin(), means.end()};
}

double spread(std::span<const glm::vec3> gradient) {
    LODESTAR_EXPECT(gradient.size() == kGradientColumns, "the gradient has its columns");
    double power = 0.0;
    double moment = 0.0;
    double above = 1.0; // cos of the ring's near edge
    for (std::size_t i = 0; i < gradient.size(); ++i) {
        const double below = std::cos(gradientEdges()[i + 1]);
        const auto radiance = static_cast<double>(gradient[i].r + gradient[i].g + gradient[i].b);
        const double ring = radiance * radiance * (above - below);
        power += ring;
        moment += ring * (2.0 - above - below); // |l - axis|^2 = 2 - 2 z, linear in z
        above = below;
    }
    return power > 0.0 ? moment / power : 0.0;
}

glm::vec4 storedTexel(const RsrmTexels& texels, int column, int row) {
    const RsrmLayout& layout = texels.layout;
    LODESTAR_EXPECT(column >= 0 && column < layout.columns && row >= 0 && row < layout.rows,
                    "the texel is in the map");
    const std::size_t each = texelBytes(layout) / (static_cast<std::size_t>(layout.columns) *
                                                   static_cast<std::size_t>(layout.rows));
    const std::size_t at =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(layout.columns) +
        static_cast<std::size_t>(column);
    return readTexel(layout.encoding, texels.bytes.data() + each * at);
}

std::vector<glm::vec3> storedRows(const RsrmLayout& layout, const RsrmBake& bake) {
    const bool roots = layout.columnMap == RsrmColumns::Refined;
    // Values as they are may be beyond halves; their roots, at most 31623, are not.
    const float scale = !roots || layout.encoding == RsrmEncoding::Unorm8 ? greatest(bake) : 1.0f;
    std::vector<glm::vec3> rows;
    std::vector<std::uint8_t> bytes;
    for (std::size_t k = 0; k < bake.exponents.size(); ++k) {
        for (std::size_t i = 0; i < bake.columns; ++i) {
            const glm::vec3 value =
                glm::max(glm::vec3(bake.value(k, 0)[i], bake.value(k, 1)[i], bake.value(k, 2)[i]),
                         0.0f) /
                scale;
            bytes.clear();
            appendTexel(bytes, layout.encoding, roots ? glm::sqrt(value) : value);
            const glm::vec3 read(readTexel(layout.encoding, bytes.data()));
            rows.push_back((roots ? read * read : read) * scale);
        }
    }
    return rows;
}

} // namespace lodestar::lighting

namespace lodestar::shader {

namespace {

/// Texels read as a GPU reads them, bilinear.
struct RsrmCpuHost {
    const lighting::RsrmTexels* texels = nullptr;
    std::span<const vec3> gradient;
    std::array<float, lighting::kMostOwnRows> octaves{}; ///< where the layout has its own rows

#define LODESTAR_HOST_CLASS
#include "lodestar/rsrm.glsl"
#undef LODESTAR_HOST_CLASS

    [[nodiscard]] vec4 lodestar_host_rsrm(float column, float row, int) const {
        const int left = std::min(static_cast<int>(column), texels->layout.columns - 2);
        const float t = column - static_cast<float>(left);
        const int top = std::min(static_cast<int>(row), texels->layout.rows - 2);
        vec4 value = glm::mix(glm::mix(lighting::storedTexel(*texels, left, top),
                                       lighting::storedTexel(*texels, left + 1, top), t),
                              glm::mix(lighting::storedTexel(*texels, left, top + 1),
                                       lighting::storedTexel(*texels, left + 1, top + 1), t),
                              row - static_cast<float>(top));
        value.a = texels->scale;
        return value;
    }

    [[nodiscard]] vec3 lodestar_host_rsrmLambert(float u, int) const {
        const auto count = static_cast<float>(texels->lambert.size());
        return published() ? between(texels->lambert, u * count - 0.5f)
                           : between(texels->lambert, u * (count - 1.0f));
    }

    [[nodiscard]] vec4 lodestar_host_rsrmOctaves(int index) const {
        const float* four = octaves.data() + 4 * index;
        return {four[0], four[1], four[2], four[3]};
    }

    [[nodiscard]] vec3 lodestar_host_rsrmGradient(float u2, int) const {
        return between(gradient, u2 * static_cast<float>(gradient.size() - 1));
    }

    [[nodiscard]] bool published() const {
        return texels->layout.columnMap == lighting::RsrmColumns::UniformHeight;
    }

    /// Linear between values; the first and the last beyond them.
    [[nodiscard]] static vec3 between(std::span<const vec3> values, float at) {
        const float inside = std::clamp(at, 0.0f, static_cast<float>(values.size() - 1));
        const std::size_t left = std::min(static_cast<std::size_t>(inside), values.size() - 2);
        return glm::mix(values[left], values[left + 1], inside - static_cast<float>(left));
    }
};

LodestarRsrm describe(const lighting::RsrmLayout& layout) {
    LodestarRsrm map{};
    map.layoutName = layout.columnMap == lighting::RsrmColumns::UniformHeight
                         ? LODESTAR_RSRM_PUBLISHED
                         : LODESTAR_RSRM_REFINED;
    map.axis = {0.0f, 0.0f, 1.0f};
    map.columns = static_cast<float>(layout.columns);
    map.rows = static_cast<float>(layout.rows);
    map.leastExponent = static_cast<float>(layout.leastExponent);
    map.greatestExponent = static_cast<float>(layout.greatestExponent);
    map.firstOctave = static_cast<float>(lighting::firstOctave(layout));
    map.rowsPerOctave = static_cast<float>(lighting::rowsPerOctave(layout));
    return map;
}

vec3 directionAt(double theta) {
    return {static_cast<float>(std::sin(theta)), 0.0f, static_cast<float>(std::cos(theta))};
}

} // namespace

} // namespace lodestar::shader

namespace lodestar::lighting {

glm::vec3 rsrmRadiance(const RsrmTexels& texels, std::span<const glm::vec3> gradient, double theta,
                       double exponent) {
    LODESTAR_EXPECT(gradient.size() >= 2, "a gradient has a value at either pole");
    shader::RsrmCpuHost host{&texels, gradient};
    const shader::LodestarRsrm map = shader::describe(texels.layout);
    const auto s = static_cast<float>(exponent);
    float row = 0.0f;
    if (hasOwnRows(texels.layout)) {
        host.octaves = rowOctaves(texels.layout);
        row = host.lodestar_rsrmOwnRow(map, s);
    } else {
        row = shader::lodestar_rsrmRow(map, s);
    }
    return host.lodestar_rsrm(map, shader::directionAt(theta), row);
}

glm::vec3 rsrmLambert(const RsrmTexels& texels, double theta) {
    shader::RsrmCpuHost host{&texels, {}};
    return host.lodestar_rsrmLambert(shader::describe(texels.layout), shader::directionAt(theta));
}

} // namespace lodestar::lighting
