// SPDX-License-Identifier: MIT
//
// How far a frame is from a reference by many taps: figures, and a picture in false colour.
#pragma once

#include <cstddef>

#include <nlohmann/json_fwd.hpp>

#include "core/image.h"
#include "plan/effect_plan.h"
#include "scene/renderer.h"

namespace lodestar::app {

/// Relative errors over the pixels that show a surface (docs/estimators.md): the sum over r, g, b
/// of |frame - reference| over that of the reference, or over a tenth of its mean if that is more.
struct ErrorFigures {
    double mean = 0.0;
    double rms = 0.0;
    double worst = 0.0;
    int worstX = 0, worstY = 0; ///< from the top left
    std::size_t pixels = 0;     ///< that show a surface; the rest is 0 for none
    /// The reference's own: the mean of half the difference between its even and its odd passes; 0
    /// until there are two.
    double spread = 0.0;
};

/// A frame, and the mean of the passes of its reference so far.
class ErrorView {
public:
    /// Of what share of the reference's mean a darker pixel's error is taken.
    static constexpr double kLeastShare = 0.1;

    /// @param frame linear radiance, premultiplied by coverage, 4 channels; alpha 0: no surface
    explicit ErrorView(core::Image frame);

    /// @pre of the frame's size
    void add(const core::Image& pass);
    [[nodiscard]] int passes() const { return passes_[0] + passes_[1]; }
    /// @pre a pass has been added
    [[nodiscard]] ErrorFigures figures() const;

    /// The errors in false colour, sRGB-encoded, no surface grey; with a legend in per cent beneath
    /// (the picture is then higher, and at least 260 pixels wide) or over the lowest rows.
    /// @param full the error that has the last colour, > 0  @pre a pass has been added
    enum class Legend { Beneath, Over };
    [[nodiscard]] core::Image picture(double full, Legend legend) const;

private:
    [[nodiscard]] double mean(std::size_t pixel, int channel) const;
    [[nodiscard]] double errorAt(std::size_t pixel, double least) const;
    [[nodiscard]] bool surface(std::size_t pixel) const;
    /// A tenth of the reference's mean over surfaces.
    [[nodiscard]] double least() const;

    core::Image frame_;
    core::Image sums_[2]; ///< of the even and the odd passes
    int passes_[2] = {0, 0};
};

/// Whether an environment, a sky or a sun lights a surface that a plan draws: what a reference is
/// made of.
[[nodiscard]] bool litFromAfar(const plan::EffectPlan& plan);

[[nodiscard]] nlohmann::json toJson(const ErrorFigures& figures, int taps);

/// The error that has the last colour, where nothing else is asked for.
inline constexpr double kErrorScale = 0.25;
/// Taps of a reference where nothing else is asked for.
inline constexpr int kErrorTaps = 1024;
/// A reference is drawn in so many passes, each of the same share of its taps.
inline constexpr int kReferencePasses = 16;

} // namespace lodestar::app
