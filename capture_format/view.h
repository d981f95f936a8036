// Where a frame is seen from.
//
//   View space   +x right, +y up, +z forward: left-handed. view = to_view * (world - origin); z is the view depth, in meters.
//   Clip space   Vulkan's: +x right, +y down, z / w from 0 to 1. Depth is reversed and has no far plane: z / w = near / depth is
//                1 at the near plane and 0 at infinity.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace strata {

/// The eye, its axes and its lens. look_at() and perspective() make the matrices.
struct View {
    glm::dvec3 origin{0};     ///< the eye, world
    glm::dmat3 to_view{1};    ///< world to view; its determinant is -1 in a right-handed world and 1 in a left-handed one
    glm::mat4 projection{0};  ///< clip = (P00 x + P20 z, -(P11 y + P21 z), near, z) of view space; jitter is not in it
    glm::vec2 jitter{0};      ///< NDC, added to x / w and y / w
    std::uint32_t width = 160, height = 90;
    std::uint32_t samples = 1;  ///< 1 or 4
    float near = 0.1f;          ///< meters
    float exposure = 1;
};

/// Where the world's +z points when +x is right and +y is up: towards the viewer (right, as in glTF and OpenGL) or away from the
/// viewer (left, as in Direct3D).
enum class Handedness : std::uint32_t { right, left };

/// An eye as applications describe it.
struct Camera {
    glm::dvec3 eye{0}, target{0, 0, -1};  ///< world
    glm::dvec3 up{0, 1, 0};               ///< world; any length, any direction but that of the target
    double vertical_fov = 0.8;            ///< radians between the lower and the upper edge of the image
    double near = 0.1;                    ///< meters
    std::uint32_t width = 160, height = 90;
    Handedness handedness = Handedness::right;  ///< of the world
};

/// The View of a camera; the target is in the middle of the image. Where `up` is parallel to the direction of the target, -z is
/// up instead (+y where -z is parallel, too).
View look_at(const Camera&);

/// View::to_view of an eye that looks along `forward`. The vectors need not be unit; they must not be parallel.
glm::dmat3 look_along(glm::dvec3 forward, glm::dvec3 up, Handedness = Handedness::right);

/// View::projection for a vertical field of view in radians. `near` must be View::near.
glm::mat4 perspective(double vertical_fov, double width_over_height, double near);

}  // namespace strata
