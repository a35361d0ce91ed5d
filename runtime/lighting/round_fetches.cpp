// SPDX-License-Identifier: MIT
//
// Directions are in the frame of the face that is made, taken to be +Z, and texels are numbered
// there: the other faces' weights are the same, turned.
#include "lighting/round_fetches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "lighting/cubemap.h"
#include "lighting/round_levels.h"
#include "lighting/table_cache.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {

namespace {

constexpr std::size_t kFaces = 6;

double coordinateOf(int i, int width) {
    return static_cast<double>(2 * i + 1) / width - 1.0;
}

glm::dvec3 directionOf(int face, double u, double v) {
    return glm::dvec3(
        shader::lodestar_cubeDirection(face, static_cast<float>(u), static_cast<float>(v)));
}

/// A cosine lobe; what of it lies below a share of its peak is left out, the rest lowered by as
/// much, so that few texels have a weight and none of them a jump.
class Lobe {
public:
    explicit Lobe(double exponent)
        : exponent_(exponent), floor_(exponent > 0.0 ? kFloor : 0.0),
          least_(exponent > 0.0 ? std::pow(kFloor, 1.0 / exponent) : 0.0) {}

    /// @param cosine of the angle from its axis
    [[nodiscard]] double weight(double cosine) const {
        return cosine > least_ ? std::pow(cosine, exponent_) - floor_ : 0.0;
    }
    /// 1 - the mean cosine (MIP-14).
    [[nodiscard]] double spread() const {
        const auto moment = [this](double power) { // of x^power
            return (1.0 - std::pow(least_, exponent_ + power + 1.0)) / (exponent_ + power + 1.0) -
                   floor_ * (1.0 - std::pow(least_, power + 1.0)) / (power + 1.0);
        };
        return 1.0 - moment(1.0) / moment(0.0);
    }
    [[nodiscard]] static Lobe ofSpread(double spread) {
        double low = 0.0; // log2(s + 1)
        double high = 23.0;
        for (int i = 0; i < 40; ++i) {
            const double middle = 0.5 * (low + high);
            (Lobe(std::exp2(middle) - 1.0).spread() > spread ? low : high) = middle;
        }
        return Lobe(std::exp2(low) - 1.0);
    }

private:
    /// Fetches are few, errors small: .003 takes a sixth more and gains a thousandth on the ladder.
    static constexpr double kFloor = 0.01;
    double exponent_;
    double floor_;
    double least_; ///< cosine
};

/// The spread of what a round level's texel is to hold: the lobe's for which the level is read,
/// less a share of the hat that reads it (MIP-12).
double spreadOfTexel(double effectiveWidth, double solidAngle) {
    constexpr double kHatShare = 0.6;
    return 1.0 / (exponentOfTentLevel(effectiveWidth) + 2.0) - kHatShare * solidAngle / 6.0;
}

/// Up to two by two texels of a face, between whose centres one fetch reads.
struct Patch {
    int face;
    std::array<std::size_t, 4> texels; ///< row by row; of one column or row, each twice
    glm::dvec2 first;                  ///< face coordinates of the first's centre
    glm::dvec2 extent;                 ///< from there to the last's
};

/// The first and last texels of patches along a side, the same from either end: pairs, and in the
/// middle of an odd side one or three alone. Texels of a face of 7 or fewer are too far apart for
/// products: all alone.
std::vector<std::pair<int, int>> pairsOf(int width) {
    constexpr int kAlone = 7;
    const int even = width % 2 == 0 ? width / 2 : 2 * ((width - 1) / 4);
    const int paired = width > kAlone ? even : 0; // from either end
    std::vector<std::pair<int, int>> pairs;
    for (int i = 0; i < width;) {
        const bool alone = i >= paired && i < width - paired;
        pairs.emplace_back(i, alone ? i : i + 1);
        i = pairs.back().second + 1;
    }
    return pairs;
}

/// A level that is read.
class SourceTexels {
public:
    explicit SourceTexels(int n) : width_(n) {
        const std::vector<double> face = texelSolidAngles(n);
        for (int f = 0; f < static_cast<int>(kFaces); ++f) {
            solidAngles_.insert(solidAngles_.end(), face.begin(), face.end());
            for (int i = 0; i < n * n; ++i) {
                directions_.push_back(
                    glm::normalize(directionOf(f, coordinateOf(i % n, n), coordinateOf(i / n, n))));
            }
            addPatches(f);
        }
        for (int f = 0; f < static_cast<int>(kFaces); ++f) {
            const glm::dvec3 out = directionOf(f, 0.0, 0.0);
            const glm::dvec3 along = directionOf(f, 1.0, 0.0) - out;
            const glm::dvec3 down = directionOf(f, 0.0, 1.0) - out;
            for (const glm::dvec3& d : directions_) {
                turned_[static_cast<std::size_t>(f)].push_back(
                    indexOf(glm::vec3(d.x * along - d.y * down + d.z * out)));
            }
        }
    }
    [[nodiscard]] const std::vector<double>& solidAngles() const { return solidAngles_; }
    [[nodiscard]] const std::vector<glm::dvec3>& directions() const { return directions_; }
    [[nodiscard]] const std::vector<Patch>& patches() const { return patches_; }
    /// By face, the texel that it reads where +Z reads one.
    [[nodiscard]] const std::array<std::vector<std::size_t>, kFaces>& turned() const {
        return turned_;
    }

private:
    void addPatches(int face) {
        const auto at = [&](int x, int y) {
            return static_cast<std::size_t>((face * width_ + y) * width_ + x);
        };
        const std::vector<std::pair<int, int>> pairs = pairsOf(width_);
        for (const auto& [top, bottom] : pairs) {
            for (const auto& [left, right] : pairs) {
                patches_.push_back(
                    {face,
                     {at(left, top), at(right, top), at(left, bottom), at(right, bottom)},
                     {coordinateOf(left, width_), coordinateOf(top, width_)},
                     2.0 / width_ * glm::dvec2(right - left, bottom - top)});
            }
        }
    }
    [[nodiscard]] std::size_t indexOf(const glm::vec3& direction) const {
        const glm::vec2 at = shader::lodestar_cubeCoordinates(direction);
        const auto index = [this](float c) {
            const auto width = static_cast<float>(width_);
            return std::clamp(static_cast<int>((c + 1.0f) * 0.5f * width), 0, width_ - 1);
        };
        const int face = shader::lodestar_cubeFace(direction);
        return static_cast<std::size_t>((face * width_ + index(at.y)) * width_ + index(at.x));
    }

    int width_;
    std::vector<double> solidAngles_;
    std::vector<glm::dvec3> directions_; ///< unit
    std::vector<Patch> patches_;
    std::array<std::vector<std::size_t>, kFaces> turned_;
};

/// A patch and its texels' weights; of texels that are in it twice the first has it all.
struct Share {
    const Patch* patch;
    std::array<double, 4> weights;

    [[nodiscard]] double sum() const { return weights[0] + weights[1] + weights[2] + weights[3]; }
    [[nodiscard]] double right() const { return (weights[1] + weights[3]) / sum(); }
    [[nodiscard]] double below() const { return (weights[2] + weights[3]) / sum(); }
};
using Shares = std::vector<Share>; ///< of a texel that is made

Shares sharesOf(const SourceTexels& source, const glm::dvec3& axis, const Lobe& lobe) {
    Shares shares;
    for (const Patch& patch : source.patches()) {
        Share share{&patch, {}};
        for (std::size_t i = 0; i < 4; ++i) {
            const bool again =
                (i % 2 == 1 && patch.extent.x == 0.0) || (i / 2 == 1 && patch.extent.y == 0.0);
            const std::size_t texel = patch.texels[i];
            share.weights[i] = again ? 0.0
                                     : lobe.weight(glm::dot(source.directions()[texel], axis)) *
                                           source.solidAngles()[texel];
        }
        if (share.sum() > 0.0) {
            shares.push_back(share);
        }
    }
    return shares;
}

/// Makes a patch's weights the products of their sums along rows and columns, which is what a
/// bilinear fetch can weigh, and a texel's sum to 1.
void settle(Shares& shares) {
    double total = 0.0;
    for (const Share& share : shares) {
        total += share.sum();
    }
    for (Share& share : shares) {
        const double sum = share.sum() / total;
        const double right = share.right();
        const double below = share.below();
        share.weights = {sum * (1.0 - right) * (1.0 - below), sum * right * (1.0 - below),
                         sum * (1.0 - right) * below, sum * right * below};
    }
}

/// How much all six faces together read of each texel, by the solid angles of what they make.
std::vector<double> readOf(const std::vector<Shares>& texels,
                           const std::vector<double>& solidAngles, const SourceTexels& source) {
    std::vector<double> own(source.directions().size());
    for (std::size_t t = 0; t < texels.size(); ++t) {
        for (const Share& share : texels[t]) {
            for (std::size_t i = 0; i < 4; ++i) {
                own[share.patch->texels[i]] += solidAngles[t] * share.weights[i];
            }
        }
    }
    std::vector<double> read(own.size());
    for (const std::vector<std::size_t>& turned : source.turned()) {
        for (std::size_t i = 0; i < own.size(); ++i) {
            read[turned[i]] += own[i];
        }
    }
    return read;
}

/// Scales weights in turn until a texel's sum to 1 and each texel is read in proportion to its
/// solid angle (Sinkhorn 1967).
void balance(std::vector<Shares>& texels, const std::vector<double>& solidAngles,
             const SourceTexels& source) {
    constexpr int kMostRounds = 100;
    constexpr double kClose = 1e-4; // a fifth of what a half float rounds
    for (int i = 0; i < kMostRounds; ++i) {
        for (Shares& shares : texels) {
            settle(shares);
        }
        std::vector<double> factors = readOf(texels, solidAngles, source);
        double worst = 0.0;
        for (std::size_t k = 0; k < factors.size(); ++k) {
            factors[k] = source.solidAngles()[k] / factors[k];
            worst = std::max(worst, std::abs(factors[k] - 1.0));
        }
        if (worst < kClose) {
            return;
        }
        for (Shares& shares : texels) {
            for (Share& share : shares) {
                for (std::size_t k = 0; k < 4; ++k) {
                    share.weights[k] *= factors[share.patch->texels[k]];
                }
            }
        }
    }
    for (Shares& shares : texels) {
        settle(shares);
    }
}

glm::vec4 fetchOf(const Share& share) {
    const glm::dvec2 at =
        share.patch->first + share.patch->extent * glm::dvec2(share.right(), share.below());
    const glm::dvec3 d = directionOf(share.patch->face, at.x, at.y);
    return glm::vec4(d.x, -d.y, d.z, share.sum()); // +Z's rows run against y
}

/// The lobe over which a texel takes the mean of what it reads (MIP-15).
/// @param solidAngle of the texel  @param finer of a texel that is read, near by
Lobe lobeOf(double effectiveWidth, double solidAngle, const RoundSource& source, double finer) {
    constexpr double kTentShare = 0.6 * 0.25; // as MIP-12 has it
    constexpr double kSharper = 0.98;         // measured: balanced lobes are wider by so much
    const double held =
        source.round ? spreadOfTexel(source.effectiveWidth, finer) : kTentShare * finer;
    const double wanted = spreadOfTexel(effectiveWidth, solidAngle);
    return Lobe::ofSpread(kSharper * (1.0 - (1.0 - wanted) / (1.0 - held)));
}

/// A table and what it was asked for.
struct KeptFetches {
    double effectiveWidth;
    int width;
    RoundSource source;
    RoundFetches fetches;
};

RoundFetches makeFetches(double effectiveWidth, int width, const RoundSource& read) {
    const std::vector<double> solidAngles = texelSolidAngles(width);
    const SourceTexels source(read.width);
    const double ratio = static_cast<double>(width) / read.width;
    std::vector<Shares> texels;
    for (int t = 0; t < width * width; ++t) {
        const glm::dvec3 axis =
            directionOf(4, coordinateOf(t % width, width), coordinateOf(t / width, width));
        const double solidAngle = solidAngles[static_cast<std::size_t>(t)];
        const Lobe lobe =
            width == 1 ? Lobe(0.0) // the mean over a hemisphere
                       : lobeOf(effectiveWidth, solidAngle, read, solidAngle * ratio * ratio);
        texels.push_back(sharesOf(source, glm::normalize(axis), lobe));
    }
    balance(texels, solidAngles, source);
    RoundFetches made;
    made.texels = width * width;
    for (const Shares& shares : texels) {
        made.most = std::max(made.most, static_cast<int>(shares.size()));
    }
    made.fetches.resize(static_cast<std::size_t>(made.most) * texels.size());
    for (std::size_t t = 0; t < texels.size(); ++t) {
        for (std::size_t i = 0; i < texels[t].size(); ++i) {
            made.fetches[i * texels.size() + t] = fetchOf(texels[t][i]);
        }
    }
    return made;
}

} // namespace

std::shared_ptr<const RoundFetches> roundFetches(double effectiveWidth, int width,
                                                 const RoundSource& source) {
    constexpr std::size_t kKept = 16;
    static TableCache<KeptFetches> cache(kKept);
    auto kept = cache.get(
        [&](const KeptFetches& one) {
            return one.effectiveWidth == effectiveWidth && one.width == width &&
                   one.source == source;
        },
        [&] {
            return KeptFetches{effectiveWidth, width, source,
                               makeFetches(effectiveWidth, width, source)};
        });
    return {kept, &kept->fetches};
}

} // namespace lodestar::lighting
