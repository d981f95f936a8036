#include "tests/support/thin_lens.h"

#include <cmath>
#include <numbers>

#include "passes/reference/fragments.h"

namespace strata {

std::vector<glm::dvec2> lens_places(std::uint32_t count) {
    // A spiral of Vogel that turns the other way and begins elsewhere than that of the stage's truth.
    std::vector<glm::dvec2> places;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double away = std::sqrt((i + .5) / count), angle = 1.1 + i * std::numbers::pi * (std::sqrt(5.) - 1);
        places.push_back(away * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return places;
}

Frame seen_from(const Frame& frame, const glm::dvec2& place) {
    Frame moved = frame;
    const glm::dvec2 aside = place * (double(frame.lens.aperture) / 2);
    moved.view.origin += glm::transpose(frame.view.to_view) * glm::dvec3(aside, 0);
    for (int i = 0; i < 2; ++i) {
        const double scale = double(frame.view.projection[i][i]) / double(frame.lens.focus_distance);
        moved.view.projection[2][i] = float(double(frame.view.projection[2][i]) + scale * aside[i]);
    }
    moved.lens = {};
    return moved;
}

UnlitPicture unlit_picture(const Frame& frame) {
    const VisiblePoints visible = visible_points(frame, opaque_draws(frame));
    UnlitPicture picture{ReferenceImage(visible.width, visible.height), ReferenceImage(visible.width, visible.height)};
    for (std::size_t i = 0; i < visible.points.size(); ++i) {
        const RasterPoint& point = visible.points[i];
        const bool is_surface = point.draw < frame.draws.size();
        const glm::vec3 radiance =
            is_surface ? glm::vec3(frame.materials[frame.draws[point.draw].material].base_color) : frame.background;
        picture.color.texels[i] = glm::dvec4(radiance, 1);
        picture.depth_layers.texels[i].x = is_surface ? point.depth : 0;
    }
    return picture;
}

ReferenceImage traced_through_lens(const Frame& frame, std::uint32_t places) {
    ReferenceImage mean(frame.view.width, frame.view.height);
    for (const glm::dvec2& place : lens_places(places)) {
        const ReferenceImage one = unlit_picture(seen_from(frame, place)).color;
        for (std::size_t i = 0; i < mean.texels.size(); ++i) mean.texels[i] += one.texels[i] / double(places);
    }
    return mean;
}

}  // namespace strata
