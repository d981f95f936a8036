// The light that comes straight from a frame's lights to any point of its surfaces, sampled in double: what the truth of indirect
// light bounces once. The reference of lights (passes/reference/lights.h) integrates over area lights and filters pictures over
// the pixel; a ray's hit has no pixel, and thousands of hits average their own samples.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame/light.h"
#include "passes/reference/blockers.h"
#include "passes/reference/placed_light.h"
#include "passes/reference/rays.h"

namespace strata::indirect {

/// A point of a surface in view space, and the side that light falls on.
struct LitSide {
    glm::dvec3 position{0}, normal{0, 0, -1};
};

class DirectLight {
public:
    /// The frame's shining lights. Keeps a reference to the frame.
    explicit DirectLight(const Frame&);
    std::size_t lights() const { return sources_.size(); }

    /// Irradiance from one light: its mean over places in the unit square is exact. A place is a point of the emitter of an area
    /// light, and of the source of a soft shadow. What shadow casters, the light's blockers and its clip planes stop is 0.
    /// Pictures are read at mip 0. Darks give nothing: they take away direct light alone (docs/algorithms/lighting.md N9).
    glm::dvec3 irradiance(std::size_t light, const LitSide&, glm::dvec2 place) const;

private:
    struct Source {
        Light light;
        LightBlockers blockers;
    };
    bool is_shadowed(const Light&, const LitSide&, const glm::dvec4& from) const;

    const Frame* frame_;
    RayScene casters_;
    std::vector<Source> sources_;
};

}  // namespace strata::indirect
