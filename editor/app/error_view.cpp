// SPDX-License-Identifier: MIT
#include "app/error_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/contract.h"
#include "core/font.h"
#include "ui/false_color.h"

namespace lodestar::app {
namespace {

using Color = std::array<float, 3>;

constexpr Color kPaper{0.105f, 0.112f, 0.125f};
constexpr Color kInk{0.90f, 0.885f, 0.86f};
constexpr Color kNothing{0.35f, 0.36f, 0.38f}; ///< no surface: greyer than any false colour
constexpr int kLeastWidth = 260;

std::string formatted(const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string percent(double value) {
    return formatted("%.4g", 100.0 * value) + "%";
}

void paint(core::Image& image, int x, int y, const Color& color) {
    std::copy(color.begin(), color.end(), image.at(x, y));
    image.at(x, y)[3] = 1.0f;
}

Color colorOf(double error, double full) {
    const glm::vec3 color = ui::falseColor(error / full);
    return {color.r, color.g, color.b};
}

/// Rows of the legend of a picture: a line of figures, the bar, its numbers.
struct LegendLayout {
    int scale = 1;
    int margin = 4;
    int line = 0; ///< of text
    int height = 0;

    explicit LegendLayout(int width)
        : scale(width < 640 ? 1 : 2), margin(5 * scale),
          line((core::kFontAscent + core::kFontDescent) * scale),
          height(2 * line + 10 * scale + 3 * margin) {}
};

/// A bar of the colours with numbers beneath, and the figures above.
void drawLegend(core::Image& image, const LegendLayout& layout, const ErrorFigures& figures,
                double full) {
    const int top = image.height() - layout.height;
    const int left = layout.margin;
    const int width = image.width() - 2 * layout.margin;
    for (int y = top; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            paint(image, x, y, kPaper);
        }
    }
    core::drawText(image, left, top + layout.margin,
                   "error: mean " + percent(figures.mean) + ", worst " + percent(figures.worst) +
                       ", reference's own " + percent(figures.spread),
                   layout.scale, kInk);
    const int bar = top + layout.margin + layout.line + layout.scale;
    for (int y = bar; y < bar + 8 * layout.scale; ++y) {
        for (int x = 0; x < width; ++x) {
            paint(image, left + x, y, colorOf(x * full / std::max(width - 1, 1), full));
        }
    }
    constexpr int kTicks = 5;
    for (int i = 0; i <= kTicks; ++i) {
        const std::string text = percent(full * i / kTicks) + (i == kTicks ? "+" : "");
        const int wide = core::textWidth(text, layout.scale);
        const int at = left + (width - 1) * i / kTicks;
        const int x = std::clamp(at - wide / 2, left, left + width - wide);
        core::drawText(image, x, bar + 8 * layout.scale + layout.margin, text, layout.scale, kInk);
        for (int y = 0; y < 2 * layout.scale; ++y) {
            paint(image, at, bar + 8 * layout.scale + y, kInk);
        }
    }
}

} // namespace

ErrorView::ErrorView(core::Image frame) : frame_(std::move(frame)) {
    LODESTAR_EXPECT(frame_.channels() == 4, "a frame has coverage");
    for (core::Image& sum : sums_) {
        sum = core::Image(frame_.width(), frame_.height(), 4);
    }
}

void ErrorView::add(const core::Image& pass) {
    const bool fits =
        pass.width() == frame_.width() && pass.height() == frame_.height() && pass.channels() == 4;
    LODESTAR_EXPECT(fits, "a pass has its frame's size");
    const auto parity = static_cast<std::size_t>(passes() % 2);
    for (std::size_t i = 0; i < pass.pixels().size(); ++i) {
        sums_[parity].pixels()[i] += pass.pixels()[i];
    }
    ++passes_[parity];
}

double ErrorView::mean(std::size_t pixel, int channel) const {
    const std::size_t i = 4 * pixel + static_cast<std::size_t>(channel);
    return (static_cast<double>(sums_[0].pixels()[i]) + static_cast<double>(sums_[1].pixels()[i])) /
           passes();
}

bool ErrorView::surface(std::size_t pixel) const {
    return frame_.pixels()[4 * pixel + 3] > 0.0f;
}

double ErrorView::least() const {
    double sum = 0.0;
    std::size_t surfaces = 0;
    for (std::size_t i = 0; i < frame_.pixels().size() / 4; ++i) {
        if (surface(i)) {
            sum += mean(i, 0) + mean(i, 1) + mean(i, 2);
            ++surfaces;
        }
    }
    return surfaces > 0 ? kLeastShare * sum / static_cast<double>(surfaces) : 0.0;
}

double ErrorView::errorAt(std::size_t pixel, double least) const {
    double difference = 0.0;
    double reference = 0.0;
    for (int c = 0; c < 3; ++c) {
        const double value = mean(pixel, c);
        const auto frame =
            static_cast<double>(frame_.pixels()[4 * pixel + static_cast<std::size_t>(c)]);
        difference += std::abs(frame - value);
        reference += value;
    }
    const double over = std::max(reference, least);
    return over > 0.0 ? difference / over : 0.0;
}

ErrorFigures ErrorView::figures() const {
    LODESTAR_EXPECT(passes() > 0, "a reference has a pass");
    ErrorFigures figures;
    const double floor = least();
    double squares = 0.0;
    for (std::size_t i = 0; i < frame_.pixels().size() / 4; ++i) {
        if (!surface(i)) {
            continue;
        }
        const double error = errorAt(i, floor);
        ++figures.pixels;
        figures.mean += error;
        squares += error * error;
        if (error > figures.worst) {
            figures.worst = error;
            figures.worstX = static_cast<int>(i) % frame_.width();
            figures.worstY = static_cast<int>(i) / frame_.width();
        }
        double halves = 0.0;
        double reference = 0.0;
        for (int c = 0; passes_[1] > 0 && c < 3; ++c) {
            const std::size_t k = 4 * i + static_cast<std::size_t>(c);
            halves += std::abs(static_cast<double>(sums_[0].pixels()[k]) / passes_[0] -
                               static_cast<double>(sums_[1].pixels()[k]) / passes_[1]);
            reference += mean(i, c);
        }
        const double over = std::max(reference, floor);
        figures.spread += over > 0.0 ? 0.5 * halves / over : 0.0;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(figures.pixels, 1));
    figures.mean /= count;
    figures.rms = std::sqrt(squares / count);
    figures.spread /= count;
    return figures;
}

core::Image ErrorView::picture(double full, Legend legend) const {
    LODESTAR_EXPECT(full > 0.0, "an error above 0 has the last colour");
    const bool beneath = legend == Legend::Beneath;
    const int width = beneath ? std::max(frame_.width(), kLeastWidth) : frame_.width();
    const LegendLayout layout(width);
    core::Image image(width, frame_.height() + (beneath ? layout.height : 0), 4);
    const double floor = least();
    const int left = (width - frame_.width()) / 2;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < width; ++x) {
            paint(image, x, y, kPaper);
        }
    }
    for (int y = 0; y < frame_.height(); ++y) {
        for (int x = 0; x < frame_.width(); ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame_.width()) +
                           static_cast<std::size_t>(x);
            paint(image, left + x, y, surface(i) ? colorOf(errorAt(i, floor), full) : kNothing);
        }
    }
    if (image.height() >= layout.height) {
        drawLegend(image, layout, figures(), full);
    }
    return image;
}

bool litFromAfar(const plan::EffectPlan& plan) {
    return std::any_of(plan.drawFeatures.begin(), plan.drawFeatures.end(),
                       [](plan::Features features) {
                           return plan::has(features, plan::Feature::Environment) ||
                                  plan::has(features, plan::Feature::RsrmLights);
                       });
}

nlohmann::json toJson(const ErrorFigures& figures, int taps) {
    return {{"mean", figures.mean},
            {"rms", figures.rms},
            {"worst", figures.worst},
            {"worst_at", {figures.worstX, figures.worstY}},
            {"pixels", figures.pixels},
            {"taps", taps},
            {"reference_spread", figures.spread}};
}

} // namespace lodestar::app
