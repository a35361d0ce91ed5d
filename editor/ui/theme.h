// SPDX-License-Identifier: MIT
//
// How the editor looks: a dark, quiet palette that leaves colour to what is painted.
#pragma once

#include <glm/vec3.hpp>
#include <imgui.h>

namespace lodestar::ui {

/// Text whose contrast with panels is 11 : 1, and dimmer text at 5 : 1 (WCAG 2.1 asks 4.5).
inline const ImVec4 kText{0.88f, 0.89f, 0.90f, 1.0f};
inline const ImVec4 kDimText{0.60f, 0.62f, 0.65f, 1.0f};
inline const ImVec4 kPanel{0.125f, 0.130f, 0.140f, 1.0f};
inline const ImVec4 kAccent{0.93f, 0.64f, 0.25f, 1.0f}; ///< selected, playing, dragged
inline const ImVec4 kWarning{1.0f, 0.55f, 0.45f, 1.0f};

/// Sets style, sizes and fonts of the current context. @param scale of the display, 1 to 8
void applyTheme(float scale);

/// Radiance as the renderer shows it: a factor, the filmic curve, sRGB. @param exposure factor
[[nodiscard]] ImU32 shownColor(const glm::dvec3& radiance, double exposure);
/// Stops of radiance from the first of the false colours to the last.
inline constexpr double kFalseColorStops = 16.0;
/// The same in false colours: the mean of the channels, `exposure`'s white in their middle.
[[nodiscard]] ImU32 falseShownColor(const glm::dvec3& radiance, double exposure);

} // namespace lodestar::ui
