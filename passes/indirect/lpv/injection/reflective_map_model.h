// Reflective shadow maps by casting rays, in double: every texel of a light's map whose ray meets a surface becomes a virtual
// light (docs/algorithms/lighting.md 5.2; Dachsbacher, Stamminger, Reflective Shadow Maps, I3D 2005).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "passes/indirect/lpv/grids_model.h"
#include "passes/indirect/lpv/injection/injection_model.h"
#include "passes/reference/blockers.h"
#include "passes/reference/rays.h"

namespace strata::indirect::in_double {

/// The surfaces of a frame that reflect. Keeps a reference to the frame.
class ReflectiveMaps {
public:
    /// `most_texels` a side; `density`: texels per cell, 0 for as many as may be.
    ReflectiveMaps(const Frame&, std::uint32_t most_texels, double density);

    /// One map for a spot, six for other lights that are not directional. Row by row. As fine as the grids of the frame want.
    std::vector<VirtualLight> of_local(const Light&, std::span<const Grid>) const;
    /// The map of a directional light over a grid: three times as fine.
    std::vector<VirtualLight> of_directional(const Light&, const Grid&) const;

private:
    /// A ray from a light in world space, in lengths of `direction`.
    struct LightRay {
        glm::dvec3 origin{0}, direction{0};
        double begin = 0;
    };
    struct MapSide;
    struct Surface;
    struct InTheWay;
    template <typename Texel>
    std::vector<VirtualLight> map_of(std::uint32_t texels, const Texel&) const;
    std::uint32_t texels_of(const Light&, std::span<const Grid>) const;
    std::vector<VirtualLight> side_of(const Light&, const InTheWay&, const MapSide&) const;
    std::optional<Surface> met(const LightRay&) const;
    bool is_reached(const Light&, const InTheWay&, const Surface&) const;

    const Frame* frame_;
    std::uint32_t most_texels_;
    double density_;
    RayScene scene_;
};

}  // namespace strata::indirect::in_double
