// SPDX-License-Identifier: MIT
//
// Kernels: the zone weights of every column and exponent of a map, built once a kind of map. A bake
// is a product of a kernel with zonal radiance.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "lighting/rsrm_layout.h"
#include "lighting/zonal.h"

namespace lodestar::lighting {

/// Filtered radiance, linear in what was filtered, as planes of columns: value(exponent, channel)
/// points at the first of its columns.
struct RsrmBake {
    std::vector<double> exponents;
    std::size_t columns = 0;
    std::vector<float> planes; ///< [exponent][channel][column]
    /// Means over Lambert's lobe at lambertAngles(); empty where the kernel has none.
    std::vector<glm::vec3> lambert{};

    [[nodiscard]] const float* value(std::size_t exponent, std::size_t channel) const {
        return planes.data() + (3 * exponent + channel) * columns;
    }
    [[nodiscard]] float* value(std::size_t exponent, std::size_t channel) {
        return planes.data() + (3 * exponent + channel) * columns;
    }
};

class RsrmKernel {
public:
    using Others = std::vector<std::shared_ptr<const RsrmKernel>>;

    /// Exact weights for directions at these angles from the axis and these Phong exponents.
    /// @param thetas radians [0, pi]  @param exponents [0, 1e7]
    RsrmKernel(const Zones& zones, const std::vector<double>& thetas,
               std::vector<double> exponents);
    /// The same for rows that move: quick, within 1e-8 of the lobe's peak (RSRM-14).
    /// @param exponents [1, 16384]  @param low of these zones and angles and of lowExponents()
    /// @param others made by this, of these zones and angles: weights of exponents that they have
    /// are shared
    RsrmKernel(const RsrmKernel& low, const std::vector<double>& thetas,
               std::vector<double> exponents, const Others& others);
    /// Chebyshev's points in log(s + 1) from 1 to 8.
    [[nodiscard]] static std::vector<double> lowExponents();
    /// Stone's sampled weights (publishedWeights), 128 azimuths.
    [[nodiscard]] static RsrmKernel published(int zones, const std::vector<double>& thetas,
                                              std::vector<double> exponents);

    [[nodiscard]] const Zones& zones() const { return zones_; }
    [[nodiscard]] const std::vector<double>& exponents() const { return exponents_; }
    [[nodiscard]] std::size_t columns() const { return columns_; }

    /// @pre the radiance has the kernel's zones
    [[nodiscard]] RsrmBake bake(const ZonalRadiance& radiance) const;

    /// Bakes means over Lambert's lobe too, at lambertAngles().
    void addLambert();
    /// The same by another's weights. @pre it has them, of these zones
    void addLambert(const RsrmKernel& other);

private:
    using Weights = std::vector<float>; ///< [zone][column]

    RsrmKernel(const Zones& zones, std::size_t columns, std::vector<double> exponents);
    [[nodiscard]] std::shared_ptr<Weights> find(double exponent) const;
    [[nodiscard]] std::shared_ptr<Weights> between(double exponent) const;
    void store(std::size_t exponent, std::size_t column, const double* weights);
    void buildByRings(const std::vector<double>& thetas, const std::vector<double>& edges,
                      const std::vector<std::size_t>& which);
    void buildBySeries(const std::vector<double>& thetas, const std::vector<double>& edges,
                       const std::vector<std::size_t>& which);

    Zones zones_;
    std::size_t columns_;
    std::vector<double> exponents_;
    std::vector<std::shared_ptr<Weights>> weights_; ///< by exponent; written while it is made alone
    std::shared_ptr<const RsrmKernel> lambert_;     ///< of exponent 1; null: none
};

/// The kernels of a program, each built at its first use. Safe to use from several threads; a
/// kernel that one thread builds, others wait for. Of layouts with rows given one by one those last
/// built are kept, so that rows may be moved all day, and of a new one only the exponents are built
/// that none of these has.
class RsrmKernels {
public:
    /// The kernel that bakes a layout's maps of a kind of light.
    [[nodiscard]] std::shared_ptr<const RsrmKernel> get(const RsrmLayout& layout, LightKind kind);

private:
    struct Entry {
        RsrmLayout layout;
        Zones zones;
        std::shared_ptr<const RsrmKernel> kernel;
    };
    static constexpr std::ptrdiff_t kKeptOwn = 6; ///< three pairs of a sky's and a sun's

    [[nodiscard]] std::shared_ptr<const RsrmKernel> made(const RsrmLayout& layout,
                                                         const Zones& zones);
    [[nodiscard]] std::shared_ptr<const RsrmKernel> withOwnRows(const RsrmLayout& layout,
                                                                const Zones& zones);

    std::mutex mutex_;
    std::vector<Entry> entries_;
    std::vector<std::shared_ptr<const RsrmKernel>> low_; ///< of lowExponents()
};

/// The zones that a layout bakes a kind of light from: Stone's for the published ones.
[[nodiscard]] Zones zonesFor(const RsrmLayout& layout, LightKind kind);

} // namespace lodestar::lighting
