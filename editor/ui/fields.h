// SPDX-License-Identifier: MIT
//
// Fields of forms: numbers that stay in their range however they are typed, colours of light.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "ui/studio.h"

namespace lodestar::ui {

/// A label in the form's left column; what follows fills the right one.
void label(const char* text);
/// A heading over a group of fields.
void heading(const char* text);

/// A number that is dragged, or typed with Ctrl + click or Enter, always within its range.
/// @param format printf's @return the new value, where it was changed
[[nodiscard]] std::optional<double> numberField(const char* id, double value, float speed,
                                                double least, double most, const char* format);
/// Three numbers in a row, written with as many digits as there is room for.
/// @return whether a finite number was typed or dragged
[[nodiscard]] bool numbersField(const char* id, glm::dvec3& values, float speed, double least,
                                double most);
/// Linear colour in channels of [0, most], with a swatch that opens a picker.
/// @param exposure factor by which the swatch is shown
[[nodiscard]] std::optional<glm::dvec3> colorField(const char* id, const glm::dvec3& value,
                                                   double most, double exposure);
/// A choice of a list. @return the new index, where another was chosen
[[nodiscard]] std::optional<std::size_t> choiceField(Studio& studio, const char* id,
                                                     std::size_t chosen,
                                                     std::span<const char* const> choices);
/// Goes on in the line where what comes next has room there, else in the next line.
/// @param width of what comes next, pixels
void continueRow(float width);
/// The width of a button.
[[nodiscard]] float buttonWidth(const char* text);
/// A text that ends in dots where it is wider than its room, pixels.
[[nodiscard]] std::string elided(const std::string& text, float room);
/// The same as an item, whose tooltip then has it whole.
void elidedText(const ImVec4& color, const std::string& text, float room);
/// Dear ImGui 1.86 keeps the undo of the last field of text for when it is entered again. What it
/// is entered with is another text by then, beyond whose ends those steps reach: forgets them. To
/// be called once a frame, before any field.
void forgetLeftText();
/// Begins a popup over all that waits for an answer, where it is open; ImGui::EndPopup ends it.
[[nodiscard]] bool beginQuestion(const char* title);
/// A button that says with a tooltip which key it has.
[[nodiscard]] bool button(Studio& studio, const char* text, const char* shortcut);

/// The direction of an axis as degrees: x azimuth clockwise from north (-Z), y elevation.
[[nodiscard]] glm::dvec2 degreesOfAxis(const glm::dvec3& axis);
[[nodiscard]] glm::dvec3 axisOfDegrees(const glm::dvec2& degrees);

} // namespace lodestar::ui
