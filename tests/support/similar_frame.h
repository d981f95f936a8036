// The same frame elsewhere: moved, turned, mirrored and in another size, so that a picture of it is the same.
#pragma once

#include <glm/glm.hpp>

#include "capture_format/frame/frame.h"

namespace strata {

/// point' = scale * turn * (point - around) + around + shift, in the world.
struct Similarity {
    glm::dmat3 turn{1};  ///< orthogonal; its determinant is -1 in a mirror image
    double scale = 1;
    glm::dvec3 shift{0};
    glm::dvec3 around{0};
};

inline const glm::dmat3 mirror_x(-1, 0, 0, 0, 1, 0, 0, 0, 1);      ///< left is right
inline const glm::dmat3 quarter_turn(0, 0, -1, 0, 1, 0, 1, 0, 0);  ///< yaw by 90 degrees

/// Everything in a frame that is a point, a direction, a length or a power of one, by the schema's comments. Intensities grow
/// with the square of the scale, so that surfaces are as bright; those of area lights are radiance. The picture of a mirrored
/// frame is mirrored, but for pictures that lights throw: v of a light's picture is a cross product. Grids of light volumes stay
/// along the axes, so turns are by quarters.
Frame similar(Frame, const Similarity&);

}  // namespace strata
