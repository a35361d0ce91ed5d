// SPDX-License-Identifier: MIT
//
// A window with a photograph and the ways from it to a gradient: the whole sky and its sun, the
// mean over azimuth, a line, a pixel.
#pragma once

#include "model/picture_gradient.h"
#include "ui/studio.h"

namespace lodestar::ui {

/// Stops of a gradient that comes from a photograph, as many as lightsFromPanorama's skies have.
inline constexpr std::size_t kPhotographStops = 16;

class PhotographPanel {
public:
    /// Draws the window while the surroundings have a photograph.
    void draw(Studio& studio);

private:
    enum class Way { Lights, Mean, Line, Pixel };
    struct Place; ///< of the picture in the window

    void drawPicture(Studio& studio);
    void pointer(Studio& studio, const Place& place);
    void drawMarks(Studio& studio, const Place& place) const;
    void drawWays(Studio& studio);
    void drawLights(Studio& studio);
    void drawMean(Studio& studio);
    void drawLine(Studio& studio);
    void drawAxis(Studio& studio);
    void useLine(Studio& studio);
    [[nodiscard]] glm::dvec3 axis(const Photograph& photograph) const;

    std::shared_ptr<const core::Image> shown_; ///< that the values below belong to
    Way way_ = Way::Lights;
    std::size_t axisChoice_ = 0; ///< up, the sun's, other
    glm::dvec2 axisDegrees_{0.0, 90.0};
    bool takesSun_ = true;
    model::PictureLine line_;
    bool hasLine_ = false;
    bool byElevation_ = true; ///< the ends of a line over a panorama stand for their elevations
};

} // namespace lodestar::ui
