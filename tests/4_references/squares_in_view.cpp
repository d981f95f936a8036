#include "tests/4_references/squares_in_view.h"

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"

namespace strata {

Frame empty_view() {
    Frame frame;
    frame.view.projection[0][0] = frame.view.projection[1][1] = 2;
    frame.view.projection[2][3] = 1;
    frame.materials.emplace_back();
    return frame;
}

void add_square(Frame& frame, const glm::dvec3& center, float half) {
    frame.meshes.push_back(
        {.positions = {{-half, 0, -half}, {half, 0, -half}, {half, 0, half}, {-half, 0, half}}, .indices = {0, 1, 2, 0, 2, 3}});
    Draw& draw = frame.draws.emplace_back();
    draw.mesh = static_cast<std::uint32_t>(frame.meshes.size() - 1);
    draw.to_world[3] = glm::dvec4(center, 1);
}

}  // namespace strata
