// SPDX-License-Identifier: MIT
#include "sheet.h"

#include <algorithm>
#include <cmath>

#include <glm/vec3.hpp>

#include "core/font.h"
#include "lodestar/display.glsl"

namespace lodestar::samples {
namespace {

constexpr int kMargin = 24;
constexpr int kGap = 6; ///< between pictures
constexpr int kTitleScale = 3;
constexpr int kTextScale = 2;
constexpr int kLine = (core::kFontAscent + core::kFontDescent) * kTextScale;

const glm::vec3 kPaper{0.105f, 0.112f, 0.125f};
const glm::vec3 kMount{0.150f, 0.160f, 0.176f}; ///< behind a picture's transparent parts
const glm::vec3 kInk{0.90f, 0.885f, 0.86f};
const glm::vec3 kFaint{0.60f, 0.59f, 0.57f};

void fill(core::Image& image, int x, int y, int width, int height, const glm::vec3& color) {
    for (int j = y; j < std::min(y + height, image.height()); ++j) {
        for (int i = x; i < std::min(x + width, image.width()); ++i) {
            std::copy_n(&color.x, 3, image.at(i, j));
        }
    }
}

/// Linear, over the mount's colour, without alpha.
core::Image flatten(const core::Image& image) {
    core::Image flat(image.width(), image.height(), 3);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const float* from = image.at(x, y);
            for (int c = 0; c < 3; ++c) {
                const float over = shader::lodestar_linearFromSrgb(from[c]) * from[3];
                const float under = shader::lodestar_linearFromSrgb(kMount[c]) * (1.0f - from[3]);
                flat.at(x, y)[c] = over + under;
            }
        }
    }
    return flat;
}

/// One axis of a reduction by averaging: how much of source pixel k lies in target pixel i.
template <class Add>
void forOverlap(int i, float ratio, int size, const Add& add) {
    const float lo = static_cast<float>(i) * ratio;
    const float hi = lo + ratio;
    for (int k = static_cast<int>(lo); k < std::min(static_cast<int>(std::ceil(hi)), size); ++k) {
        const auto edge = static_cast<float>(k);
        add(k, std::max(std::min(hi, edge + 1.0f) - std::max(lo, edge), 0.0f) / ratio);
    }
}

/// Shrinks a linear image by averaging areas.
core::Image shrink(const core::Image& image, int width, int height) {
    const float ratioX = static_cast<float>(image.width()) / static_cast<float>(width);
    const float ratioY = static_cast<float>(image.height()) / static_cast<float>(height);
    core::Image narrow(width, image.height(), 3);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < width; ++x) {
            forOverlap(x, ratioX, image.width(), [&](int k, float weight) {
                for (int c = 0; c < 3; ++c) {
                    narrow.at(x, y)[c] += weight * image.at(k, y)[c];
                }
            });
        }
    }
    core::Image small(width, height, 3);
    for (int y = 0; y < height; ++y) {
        forOverlap(y, ratioY, image.height(), [&](int k, float weight) {
            for (int x = 0; x < width; ++x) {
                for (int c = 0; c < 3; ++c) {
                    small.at(x, y)[c] += weight * narrow.at(x, k)[c];
                }
            }
        });
    }
    return small;
}

void paste(core::Image& sheet, const core::Image& linear, int x, int y) {
    for (int j = 0; j < linear.height(); ++j) {
        for (int i = 0; i < linear.width(); ++i) {
            for (int c = 0; c < 3; ++c) {
                sheet.at(x + i, y + j)[c] = shader::lodestar_srgbFromLinear(linear.at(i, j)[c]);
            }
        }
    }
}

/// Stretches without filtering, so that a map's texels can be seen.
core::Image stretch(const core::Image& image, int width, int height) {
    core::Image wide(width, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            std::copy_n(image.at(x * image.width() / width, y * image.height() / height), 3,
                        wide.at(x, y));
        }
    }
    return wide;
}

/// The insets of a picture that lies at (x, y), from its lower left corner upwards.
void drawInsets(core::Image& sheet, const Cell& cell, int x, int y, int width, int height) {
    constexpr int kFrame = 2;
    const int wide = width / 3;
    const int high = wide / 4;
    int top = y + height - kGap;
    for (const core::Image& inset : cell.insets) {
        top -= high + 2 * kFrame + kGap;
        fill(sheet, x + 2 * kGap, top, wide + 2 * kFrame, high + 2 * kFrame, kInk);
        paste(sheet, stretch(flatten(inset), wide, high), x + 2 * kGap + kFrame, top + kFrame);
    }
}

/// The sizes of a row's pictures on the sheet.
struct RowLayout {
    int height = 0;
    std::vector<int> widths;
    bool captions = false;
};

RowLayout layOut(const SheetRow& row, int width) {
    const int gaps = kGap * (static_cast<int>(row.cells.size()) - 1);
    int height = row.cells[0].image.height();
    for (const Cell& cell : row.cells) {
        height = std::min(height, cell.image.height());
    }
    float total = 0.0f; // width of the row at that height
    for (const Cell& cell : row.cells) {
        total += static_cast<float>(cell.image.width() * height) /
                 static_cast<float>(cell.image.height());
    }
    const float scale = std::min(static_cast<float>(width - gaps) / total, 1.0f);
    RowLayout layout;
    layout.height = std::max(static_cast<int>(static_cast<float>(height) * scale), 1);
    for (const Cell& cell : row.cells) {
        const float aspect =
            static_cast<float>(cell.image.width()) / static_cast<float>(cell.image.height());
        layout.widths.push_back(
            std::max(static_cast<int>(static_cast<float>(height) * scale * aspect), 1));
        layout.captions = layout.captions || !cell.caption.empty();
    }
    return layout;
}

int rowHeight(const SheetRow& row, const RowLayout& layout) {
    return layout.height + (row.label.empty() ? 0 : kLine + 6) + (layout.captions ? kLine + 8 : 0) +
           14;
}

void write(core::Image& sheet, int x, int y, const std::string& text, int scale,
           const glm::vec3& color) {
    core::drawText(sheet, x, y, text, scale, {color.r, color.g, color.b});
}

void drawCentred(core::Image& sheet, int x, int width, int y, const std::string& text,
                 const glm::vec3& color) {
    write(sheet, x + (width - core::textWidth(text, kTextScale)) / 2, y, text, kTextScale, color);
}

void drawRow(core::Image& sheet, const SheetRow& row, const RowLayout& layout, int y) {
    if (!row.label.empty()) {
        write(sheet, kMargin, y, row.label, kTextScale, kInk);
        y += kLine + 6;
    }
    int used = kGap * (static_cast<int>(row.cells.size()) - 1);
    for (const int width : layout.widths) {
        used += width;
    }
    int x = (sheet.width() - used) / 2;
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
        paste(sheet, shrink(flatten(row.cells[i].image), layout.widths[i], layout.height), x, y);
        drawInsets(sheet, row.cells[i], x, y, layout.widths[i], layout.height);
        drawCentred(sheet, x, layout.widths[i], y + layout.height + 8, row.cells[i].caption, kInk);
        x += layout.widths[i] + kGap;
    }
}

} // namespace

core::Image drawSheet(const Sheet& sheet) {
    const int inner = sheet.width - 2 * kMargin;
    const int titleHeight =
        sheet.title.empty() ? 0 : (core::kFontAscent + core::kFontDescent) * kTitleScale + 8;
    const int noteHeight = sheet.note.empty() ? 0 : kLine + 10;
    const int headHeight = sheet.columns.empty() ? 0 : kLine + 8;
    std::vector<RowLayout> layouts;
    int height = kMargin + titleHeight + noteHeight + headHeight + kMargin - 14;
    for (const SheetRow& row : sheet.rows) {
        layouts.push_back(layOut(row, inner));
        height += rowHeight(row, layouts.back());
    }
    core::Image image(sheet.width, height, 3);
    fill(image, 0, 0, sheet.width, height, kPaper);
    int y = kMargin;
    write(image, kMargin, y, sheet.title, kTitleScale, kInk);
    y += titleHeight;
    write(image, kMargin, y, sheet.note, kTextScale, kFaint);
    y += noteHeight;
    const int count = static_cast<int>(sheet.columns.size());
    for (int i = 0; i < count; ++i) {
        const int x = kMargin + inner * i / count;
        drawCentred(image, x, inner / count, y, sheet.columns[static_cast<std::size_t>(i)], kFaint);
    }
    y += headHeight;
    for (std::size_t i = 0; i < sheet.rows.size(); ++i) {
        drawRow(image, sheet.rows[i], layouts[i], y);
        y += rowHeight(sheet.rows[i], layouts[i]);
    }
    return image;
}

} // namespace lodestar::samples
