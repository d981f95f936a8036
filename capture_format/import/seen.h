// What a view sees of a frame's draws at 64 x 36 points, without a device: alpha, culled faces and emitters do not count.
#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

struct Frame;  // capture_format/frame.h
struct View;   // capture_format/view.h

using WorldTriangle = std::array<glm::dvec3, 3>;

/// The triangles of all draws, world.
std::vector<WorldTriangle> world_triangles(const Frame&);

/// View depth of the nearest triangle at each point, in meters, row by row; 0 where there is none.
std::vector<double> nearest_depths(const std::vector<WorldTriangle>&, const View&);

/// The share of the picture that draws cover.
double seen_share(const Frame&);

}  // namespace strata
