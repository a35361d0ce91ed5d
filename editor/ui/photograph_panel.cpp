// SPDX-License-Identifier: MIT
#include "ui/photograph_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "ui/fields.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

/// A pixel's direction in a panorama, degrees: azimuth clockwise from -Z, elevation.
glm::dvec2 degreesOfPixel(const glm::dvec2& pixel, const core::Image& image) {
    const double turned = 360.0 * (pixel.x / image.width() - 0.5);
    return {turned < 0.0 ? turned + 360.0 : turned, 90.0 - 180.0 * pixel.y / image.height()};
}

glm::dvec2 pixelOfDegrees(const glm::dvec2& degrees, const core::Image& image) {
    const double turns = degrees.x / 360.0 + 0.5;
    return {(turns - std::floor(turns)) * image.width(),
            (90.0 - degrees.y) / 180.0 * image.height()};
}

glm::dvec3 radianceAt(const core::Image& image, const glm::dvec2& pixel) {
    const float* const texel =
        image.at(std::clamp(static_cast<int>(pixel.x), 0, image.width() - 1),
                 std::clamp(static_cast<int>(pixel.y), 0, image.height() - 1));
    return {texel[0], texel[1], texel[2]};
}

std::optional<lighting::LightKind> kindOf(const Studio& studio, model::Id key) {
    const auto place = model::findKey(studio.model.ids(), key);
    return place ? std::optional(studio.model.document().lights[place->light].kind) : std::nullopt;
}

} // namespace

struct PhotographPanel::Place {
    ImVec2 low, size;
    const core::Image* image = nullptr;

    /// Pixels of the image, from its upper left corner, held within it.
    [[nodiscard]] glm::dvec2 pixelAt(const ImVec2& at) const {
        return {std::clamp(static_cast<double>((at.x - low.x) / size.x), 0.0, 1.0) * image->width(),
                std::clamp(static_cast<double>((at.y - low.y) / size.y), 0.0, 1.0) *
                    image->height()};
    }
    [[nodiscard]] ImVec2 at(const glm::dvec2& pixel) const {
        return {low.x + size.x * static_cast<float>(pixel.x / image->width()),
                low.y + size.y * static_cast<float>(pixel.y / image->height())};
    }
};

void PhotographPanel::draw(Studio& studio) {
    const Photograph& photograph = studio.around.photograph;
    if (!photograph.radiance || photograph.radiance->empty()) {
        shown_.reset();
        return;
    }
    if (shown_ != photograph.radiance) { // another one
        shown_ = photograph.radiance;
        hasLine_ = false;
        axisChoice_ = 0;
        takesSun_ = true;
        way_ = photograph.fit ? Way::Lights : Way::Line;
    }
    const float em = ImGui::GetFontSize();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float width = std::max(std::min(31.0f * em, 0.9f * display.x), 1.0f);
    ImGui::SetNextWindowPos({0.5f * (display.x - width) - 4.0f * em, 2.5f * em},
                            ImGuiCond_Appearing);
    ImGui::SetNextWindowSize({width, 0.0f}, ImGuiCond_Always);
    bool open = true;
    ImGui::Begin("Photograph", &open,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoResize);
    drawPicture(studio);
    drawWays(studio);
    ImGui::Separator();
    if (button(studio, "Close", "")) {
        open = false;
    }
    ImGui::SameLine();
    ImGui::TextColored(kDimText, "%s, %d x %d", photograph.name.c_str(), shown_->width(),
                       shown_->height());
    ImGui::End();
    studio.wishes.closePhotograph = !open;
}

void PhotographPanel::drawPicture(Studio& studio) {
    const float room = std::max(ImGui::GetContentRegionAvail().x, 16.0f);
    const float most = 15.0f * ImGui::GetFontSize();
    const auto aspect = static_cast<float>(shown_->height()) / static_cast<float>(shown_->width());
    Place place;
    place.image = shown_.get();
    place.size = {room, std::max(room * aspect, 4.0f)};
    if (place.size.y > most) {
        place.size = {std::max(most / aspect, 4.0f), most};
    }
    place.low = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##photograph", place.size);
    studio.mark("photograph", place.low, {place.low.x + place.size.x, place.low.y + place.size.y});
    const bool hovered = ImGui::IsItemHovered() || ImGui::IsItemActive();
    pointer(studio, place);
    const ImVec2 high(place.low.x + place.size.x, place.low.y + place.size.y);
    ImDrawList* const list = ImGui::GetWindowDrawList();
    if (studio.around.photograph.picture != 0) {
        list->AddImage(reinterpret_cast<ImTextureID>(
                           static_cast<std::uintptr_t>(studio.around.photograph.picture)),
                       place.low, high);
    }
    drawMarks(studio, place);
    if (!hovered) {
        ImGui::TextColored(kDimText, "The pointer reads radiance here.");
        return;
    }
    const glm::dvec2 pixel = place.pixelAt(ImGui::GetIO().MousePos);
    const glm::dvec3 radiance = radianceAt(*shown_, pixel);
    if (studio.around.photograph.fit) {
        const glm::dvec2 degrees = degreesOfPixel(pixel, *shown_);
        ImGui::Text("azimuth %.1f\xc2\xb0  elevation %.1f\xc2\xb0   radiance %.4g  %.4g  %.4g",
                    degrees.x, degrees.y, radiance.r, radiance.g, radiance.b);
    } else {
        ImGui::Text("%.0f, %.0f   radiance %.4g  %.4g  %.4g", std::floor(pixel.x),
                    std::floor(pixel.y), radiance.r, radiance.g, radiance.b);
    }
}

void PhotographPanel::pointer(Studio& studio, const Place& place) {
    if (!ImGui::IsItemActive()) {
        return;
    }
    const bool begins = ImGui::IsItemActivated();
    const ImGuiIO& io = ImGui::GetIO();
    if (!begins && io.MouseDelta.x == 0.0f && io.MouseDelta.y == 0.0f) {
        return; // a pointer at rest changes nothing
    }
    const glm::dvec2 pixel = place.pixelAt(io.MousePos);
    if (way_ == Way::Pixel) {
        studio.give(radianceAt(*shown_, pixel));
    } else if (way_ == Way::Line && begins) {
        line_.from = line_.to = pixel;
        hasLine_ = false;
    } else if (way_ == Way::Line && pixel != line_.from) {
        line_.to = pixel;
        hasLine_ = true;
        useLine(studio);
    }
}

void PhotographPanel::drawMarks(Studio& studio, const Place& place) const {
    ImDrawList* const list = ImGui::GetWindowDrawList();
    const ImU32 accent = ImGui::GetColorU32(kAccent);
    const ImU32 dark = IM_COL32(0, 0, 0, 200);
    const float radius = 0.5f * ImGui::GetFontSize();
    const std::optional<PhotographFit>& fit = studio.around.photograph.fit;
    if (fit && fit->sun) {
        const ImVec2 at = place.at(pixelOfDegrees(degreesOfAxis(*fit->sun), *shown_));
        list->AddCircle(at, radius, dark, 0, 4.0f);
        list->AddCircle(at, radius, accent, 0, 1.5f);
    }
    if (way_ == Way::Line && hasLine_) {
        const ImVec2 from = place.at(line_.from);
        const ImVec2 to = place.at(line_.to);
        list->AddLine(from, to, dark, 4.0f);
        list->AddLine(from, to, accent, 1.5f);
        list->AddCircleFilled(from, 0.5f * radius, accent);
        list->AddCircle(to, 0.5f * radius, accent, 0, 1.5f);
    }
}

void PhotographPanel::drawWays(Studio& studio) {
    constexpr std::array<std::pair<Way, const char*>, 4> kWays = {{{Way::Lights, "Sky and sun"},
                                                                   {Way::Mean, "Mean over azimuth"},
                                                                   {Way::Line, "Line"},
                                                                   {Way::Pixel, "Pixel"}}};
    const bool panorama = studio.around.photograph.fit.has_value();
    bool first = true;
    for (const auto& [way, name] : kWays) {
        if (!panorama && (way == Way::Lights || way == Way::Mean)) {
            continue;
        }
        if (!first) {
            ImGui::SameLine();
        }
        first = false;
        if (ImGui::RadioButton(name, way_ == way)) {
            way_ = way;
        }
        studio.mark(std::string("way ") + name);
    }
    if (way_ == Way::Lights) {
        drawLights(studio);
    } else if (way_ == Way::Mean) {
        drawMean(studio);
    } else if (way_ == Way::Line) {
        drawLine(studio);
    } else {
        ImGui::TextColored(
            kDimText, studio.view.brush ? "A click gives the brush the pixel's radiance."
                                        : "A click gives the selected stops the pixel's radiance.");
    }
}

glm::dvec3 PhotographPanel::axis(const Photograph& photograph) const {
    if (axisChoice_ == 1 && photograph.fit && photograph.fit->sun) {
        return *photograph.fit->sun;
    }
    return axisChoice_ == 2 ? axisOfDegrees(axisDegrees_) : glm::dvec3(0.0, 1.0, 0.0);
}

void PhotographPanel::drawAxis(Studio& studio) {
    constexpr const char* kAxes[] = {"up", "the sun's", "another"};
    label("axis");
    const bool sun = studio.around.photograph.fit && studio.around.photograph.fit->sun;
    if (const auto chosen = choiceField(studio, "##photograph axis", axisChoice_, kAxes)) {
        if (*chosen == 1 && !sun) {
            studio.say("no sun was found in the photograph", true);
        } else {
            if (*chosen == 2) {
                axisDegrees_ = degreesOfAxis(axis(studio.around.photograph));
            }
            axisChoice_ = *chosen;
        }
    }
    if (axisChoice_ != 2) {
        return;
    }
    label("azimuth");
    axisDegrees_.x =
        numberField("##photograph azimuth", axisDegrees_.x, 0.2f, 0.0, 360.0, "%.5g\xc2\xb0")
            .value_or(axisDegrees_.x);
    studio.mark("photograph azimuth");
    label("elevation");
    axisDegrees_.y =
        numberField("##photograph elevation", axisDegrees_.y, 0.1f, -90.0, 90.0, "%.5g\xc2\xb0")
            .value_or(axisDegrees_.y);
    studio.mark("photograph elevation");
}

void PhotographPanel::drawLights(Studio& studio) {
    const PhotographFit& fit = *studio.around.photograph.fit;
    drawAxis(studio);
    label("sun");
    ImGui::Checkbox("as a light of its own", &takesSun_);
    studio.mark("takes sun");
    if (fit.takesSun) {
        const glm::dvec2 degrees = degreesOfAxis(fit.sun.value_or(glm::dvec3(0.0, 1.0, 0.0)));
        ImGui::SameLine();
        fit.sun ? ImGui::TextColored(kDimText, "%.1f\xc2\xb0 high, radius %.2g\xc2\xb0", degrees.y,
                                     fit.sunRadius)
                : ImGui::TextColored(kDimText, "none was found");
    }
    label("asymmetry");
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%.0f %% of the light;  diffuse error %.1f %%", 100.0 * fit.residual,
                100.0 * fit.diffuseError);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextColored(kDimText, "%s.", fit.advice.c_str());
    ImGui::PopTextWrapPos();
    if (button(studio, "Use as the lights", "in place of the document's")) {
        studio.wishes.lights = LightsWish{axis(studio.around.photograph), takesSun_};
    }
}

void PhotographPanel::drawMean(Studio& studio) {
    drawAxis(studio);
    if (button(studio, "Use as the gradient", "of the key that is chosen")) {
        studio.wishes.mean = MeanWish{studio.chosenKey(), axis(studio.around.photograph)};
    }
}

void PhotographPanel::drawLine(Studio& studio) {
    const auto kind = kindOf(studio, studio.chosenKey());
    if (!kind) {
        ImGui::TextColored(kDimText, "No key is chosen.");
        return;
    }
    const model::AngleRange range = model::anglesOf(*kind);
    bool changed = false;
    const bool elevations =
        studio.around.photograph.fit.has_value() && *kind == lighting::LightKind::Sky;
    if (elevations) {
        label("angles");
        changed = ImGui::Checkbox("the panorama's elevations", &byElevation_);
        studio.mark("by elevation");
    }
    if (!elevations || !byElevation_) {
        label("from, to");
        ImGui::SetNextItemWidth(8.0f * ImGui::GetFontSize());
        const auto from =
            numberField("##line from", line_.fromAt, 0.2f, range.least, range.most, "%.5g\xc2\xb0");
        studio.mark("line from");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(8.0f * ImGui::GetFontSize());
        const auto to =
            numberField("##line to", line_.toAt, 0.2f, range.least, range.most, "%.5g\xc2\xb0");
        studio.mark("line to");
        line_.fromAt = from.value_or(line_.fromAt);
        line_.toAt = to.value_or(line_.toAt);
        changed = changed || from || to;
    }
    if (changed && hasLine_) {
        useLine(studio);
    }
    ImGui::TextColored(kDimText, "A drag over the picture paints the chosen gradient.");
}

void PhotographPanel::useLine(Studio& studio) {
    const model::Id key = studio.chosenKey();
    const auto kind = kindOf(studio, key);
    if (!kind) {
        studio.say("no key is chosen for the line's gradient", true);
        return;
    }
    if (studio.around.photograph.fit && *kind == lighting::LightKind::Sky && byElevation_) {
        line_.fromAt = degreesOfPixel(line_.from, *shown_).y;
        line_.toAt = degreesOfPixel(line_.to, *shown_).y;
    }
    auto gradient = model::gradientAlongLine(*shown_, line_, *kind, kPhotographStops);
    if (!gradient) {
        studio.say(gradient.error().message(), true);
        return;
    }
    (void)studio.run(model::SetGradient{key, std::move(*gradient)});
}

} // namespace lodestar::ui
