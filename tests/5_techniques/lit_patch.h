// A patch of surface in the middle of a grid in a vacuum, which a spot lights: a lobe of light in one cell.
#pragma once

#include <cstdint>

#include "capture_format/frame.h"

namespace strata {

/// Cells are a meter wide; the middle of the middle one, an odd number of them each way, is the origin. The patch faces +z there
/// and is injected into that cell with injection=0.
Frame lit_patch(std::uint32_t cells, std::uint32_t width, std::uint32_t height);

/// A spot that lights the patch's other side as its own lights this one: two lobes that make light for all directions.
void light_from_behind(Frame&);

/// A square of Lambert surface that casts no shadow and faces along -z or +z, whichever side the eye is on.
void add_square(Frame&, const glm::dvec3& center, double half);

/// Looks from the eye at the target.
void look(Frame&, const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov);

}  // namespace strata
