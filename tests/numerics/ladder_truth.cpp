// SPDX-License-Identifier: MIT
//
// Powers of two of the cosine come by repeated squaring. Low exponents are summed over a coarser
// level of solid-angle weighted means: replacing texels of side h by those of side H adds (H^2 -
// h^2) / 12 to the variance 1 / s of the lobe along each axis, a share s H^2 / 12 (H = 2 / W): at
// most 0.3 % where kGroups puts a level, and so at most 0.3 % of the map's local contrast in the
// mean, against errors of 5 % and more that are measured. High exponents are summed in the window
// where the power is above 1e-7 of its peak; the mass outside is at most 1e-7.
// Texels hold all environments' channels side by side, so that the inner loop is SIMD over
// channels.
#include "numerics/ladder_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "lighting/mips.h"
#include "lodestar/cube.glsl"

namespace lodestar::testing {

namespace {

using glm::dvec3;
using Float4 = float __attribute__((vector_size(16)));

constexpr double kLeastWeight = 1e-7;

/// Exponents first to last (by index) summed on faces of at most this width: s H^2 / 12 <= 0.003.
struct Group {
    std::size_t first;
    std::size_t last;
    int width;
};
constexpr std::array kGroups{Group{0, 4, 64}, Group{5, 7, 128}, Group{8, 12, 256}};

/// One level: for each texel its unit direction, solid angle and channels.
struct Texels {
    std::vector<dvec3> directions;
    std::vector<double> solidAngles;
    std::vector<Float4> channels; ///< vectors a texel: vectorCount
    std::size_t vectorCount = 0;
};

Texels flatten(const std::vector<lighting::Cubemap>& chains, int width) {
    Texels texels;
    int level = 0;
    while (chains.front().width(level) > width) {
        ++level;
    }
    const int n = chains.front().width(level);
    const std::vector<double> solidAngles = lighting::texelSolidAngles(n);
    texels.vectorCount = (3 * chains.size() + 3) / 4;
    const std::size_t count = chains.front().level(level).size();
    texels.channels.resize(count * texels.vectorCount);
    for (std::size_t t = 0; t < count; ++t) {
        const int inFace = static_cast<int>(t % solidAngles.size());
        const float u =
            (2.0f * static_cast<float>(inFace % n) + 1.0f) / static_cast<float>(n) - 1.0f;
        const float v =
            (2.0f * static_cast<float>(inFace / n) + 1.0f) / static_cast<float>(n) - 1.0f;
        const int face = static_cast<int>(t / solidAngles.size());
        texels.directions.push_back(
            glm::normalize(dvec3(shader::lodestar_cubeDirection(face, u, v))));
        texels.solidAngles.push_back(solidAngles[t % solidAngles.size()]);
        for (std::size_t e = 0; e < chains.size(); ++e) {
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t channel = 3 * e + c;
                texels.channels[t * texels.vectorCount + channel / 4][channel % 4] =
                    chains[e].level(level)[t][static_cast<int>(c)];
            }
        }
    }
    return texels;
}

/// Sums for one direction: by exponent, the channels and the weight.
class Sums {
public:
    Sums(std::size_t exponents, std::size_t vectors)
        : vectors_(vectors), partial_(exponents * vectors), total_(exponents * vectors * 4),
          weight_(exponents) {}

    void add(std::size_t exponent, double weight, const Float4* channels) {
        const float w = static_cast<float>(weight);
        Float4* sum = &partial_[exponent * vectors_];
        for (std::size_t i = 0; i < vectors_; ++i) {
            sum[i] += channels[i] * w;
        }
        weight_[exponent] += weight;
    }
    /// Moves the float sums into the double ones; called every few texels, so that they lose
    /// nothing: n terms lose n / 2 units of 6e-8.
    void settle() {
        for (std::size_t i = 0; i < partial_.size(); ++i) {
            for (std::size_t k = 0; k < 4; ++k) {
                total_[4 * i + k] += static_cast<double>(partial_[i][k]);
            }
            partial_[i] = Float4{};
        }
    }
    [[nodiscard]] double mean(std::size_t exponent, std::size_t channel) const {
        return total_[4 * exponent * vectors_ + channel] / weight_[exponent];
    }

private:
    std::size_t vectors_;
    std::vector<Float4> partial_;
    std::vector<double> total_;
    std::vector<double> weight_;
};

/// The least cosine whose power s is kept.
double leastCosine(int exponent) {
    return exponent == 0 ? 0.0 : std::exp(std::log(kLeastWeight) / exponent);
}

Sums sumGroup(const Texels& texels, const Group& group, const dvec3& direction) {
    constexpr std::size_t kSettle = 256;
    const std::vector<int>& exponents = ladderExponents();
    std::array<double, 16> least{};
    for (std::size_t e = group.first; e <= group.last; ++e) {
        least[e] = leastCosine(exponents[e]);
    }
    Sums sums(exponents.size(), texels.vectorCount);
    std::size_t since = 0;
    for (std::size_t t = 0; t < texels.directions.size(); ++t) {
        const double x = glm::dot(texels.directions[t], direction);
        if (x <= least[group.first]) {
            continue;
        }
        const Float4* channels = &texels.channels[t * texels.vectorCount];
        double power = x;
        int reached = 1;
        for (std::size_t e = group.first; e <= group.last && x > least[e]; ++e) {
            while (reached < exponents[e]) {
                power *= power;
                reached *= 2;
            }
            sums.add(e, (exponents[e] == 0 ? 1.0 : power) * texels.solidAngles[t], channels);
        }
        if (++since == kSettle) {
            sums.settle();
            since = 0;
        }
    }
    sums.settle();
    return sums;
}

void addCap(std::vector<WeightedDirection>& directions, const dvec3& axis, double least,
            int count) {
    const dvec3 side = glm::normalize(glm::cross(axis, dvec3(0.6, -0.8, 0.0)));
    const dvec3 up = glm::cross(axis, side);
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (1.0 - least) * (i + 0.5) / count;
        const double r = std::sqrt(1.0 - z * z);
        directions.push_back({glm::normalize(z * axis + r * std::cos(i * golden) * side +
                                             r * std::sin(i * golden) * up),
                              0.0});
    }
}

} // namespace

std::vector<WeightedDirection> ladderDirections() {
    constexpr int kSphere = 1536;
    constexpr int kCap = 384;
    const double edge = std::cos(15.0 * std::numbers::pi / 180.0);
    std::vector<WeightedDirection> directions;
    addCap(directions, kCentreAxis, -1.0, kSphere);
    addCap(directions, kCornerAxis, edge, kCap);
    addCap(directions, kCentreAxis, edge, kCap);
    const double capDensity = kCap / (2.0 * std::numbers::pi * (1.0 - edge));
    for (WeightedDirection& d : directions) {
        double density = kSphere / (4.0 * std::numbers::pi);
        for (const dvec3& axis : {kCornerAxis, kCentreAxis}) {
            density += glm::dot(d.direction, axis) > edge ? capDensity : 0.0;
        }
        d.weight = 1.0 / density;
    }
    return directions;
}

const std::vector<int>& ladderExponents() {
    static const std::vector<int> exponents{0, 1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 4096};
    return exponents;
}

std::vector<dvec3> lobeMeans(const std::vector<NamedCube>& environments,
                             const std::vector<WeightedDirection>& directions) {
    std::vector<lighting::Cubemap> chains;
    for (const NamedCube& environment : environments) {
        chains.push_back(lighting::solidAngleMips(environment.base));
    }
    const std::size_t exponents = ladderExponents().size();
    std::vector<dvec3> means(directions.size() * exponents * environments.size());
    for (const Group& group : kGroups) {
        const Texels texels = flatten(chains, group.width);
        for (std::size_t d = 0; d < directions.size(); ++d) {
            const Sums sums = sumGroup(texels, group, directions[d].direction);
            for (std::size_t e = group.first; e <= group.last; ++e) {
                for (std::size_t k = 0; k < environments.size(); ++k) {
                    means[(d * exponents + e) * environments.size() + k] = dvec3(
                        sums.mean(e, 3 * k), sums.mean(e, 3 * k + 1), sums.mean(e, 3 * k + 2));
                }
            }
        }
    }
    return means;
}

} // namespace lodestar::testing
