// What the models of G-buffer layouts have in common, in double.
#pragma once

#include <functional>

#include <glm/glm.hpp>

#include "passes/gbuffer/nearest.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::gbuffer {

/// Which sample a surface is under.
struct SampleAt {
    const Frame& frame;
    glm::dvec2 center;  ///< of the pixel, in pixels
    glm::dvec2 offset;  ///< from there to the sample
};

/// Turns a surface into what a layout gives back of it.
using Store = std::function<void(NearestSurface&, const SampleAt&)>;

/// The stage's outputs: every nearest surface, with attributes where FillParams says, stored and read back.
ImageSet stored_images(const StageInput&, const Settings&, const Store&);

/// Octahedral coordinates -1..1 of a unit vector (Cigolle et al. 2014), and back.
glm::dvec2 to_octahedron(const glm::dvec3& normal);
glm::dvec3 from_octahedron(const glm::dvec2& coordinates);

/// Steps from -1 to 1 of a coordinate: 2 steps_to_one + 1 levels, of which one is 0.
std::uint32_t octahedral_code(double coordinate, double steps_to_one);
double octahedral_coordinate(std::uint32_t code, double steps_to_one);

/// View depth as the nearest half float from the near plane to 65504 m.
double half_depth(double z, double near);

/// The outputs of a layout that keeps a material's code, depth as a half float, and of a normal what `stored` gives back.
ImageSet half_depth_images(const StageInput&, const Settings&, glm::dvec3 (*stored)(const glm::dvec3& normal));

/// A normal by way of octahedral codes.
glm::dvec3 octahedral_rounded(const glm::dvec3& normal, double steps_to_one);

/// Gives the surface the depth buffer's depth, a float, at the sample.
void rebuild_from_depth(NearestSurface&, const SampleAt&);

}  // namespace strata::gbuffer
