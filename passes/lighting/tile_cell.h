// Tiles of the screen as cells of view space, and which lights reach them, in float: tile_cell.glsl on the CPU, operation by
// operation. Change both.
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "passes/lighting/cells.h"

namespace strata {

struct ViewRecord;  // passes/shaders/scene/view.shared.h

}  // namespace strata

namespace strata::lighting {

/// The ray (x, y, 1) through a point of the image; pixel centers are at +.5.
glm::vec3 view_ray(const ViewRecord&, glm::vec2 pixel);

/// Of tile_size x tile_size pixels, cut off at the picture's edge, from z_near to z_far (meters of view depth).
Cell<float> tile_cell(const ViewRecord&, glm::uvec2 tile, std::uint32_t tile_size, glm::vec2 z_near_far);

/// The numbers of a light that culling asks.
struct TouchedBy {
    const LightRecord& light;
    std::span<const ClipPlaneRecord> clip_planes;  ///< the scene's
    float slack = 0;                               ///< meters within which "outside" proves nothing
};
float cell_slack(const LightRecord&, const Cell<float>&);

bool sphere_touches(const glm::vec3& center, float radius, const Cell<float>&);
/// A cone whose half angle has this cosine, by the center and radius of a sphere seen from its apex.
struct Cone {
    glm::vec3 axis{0, 0, 1};
    float cosine = 1, range = 1;
};
bool cone_touches(const Cone&, const glm::vec3& from_apex, float radius);

bool light_touches(const TouchedBy&, const Cell<float>&);
/// Whether a clip plane of the light cuts the cell, so that its points need the test.
bool is_straddled(const TouchedBy&, const Cell<float>&);

}  // namespace strata::lighting
