// Materials at points whose triangle is already known.
#pragma once

#include "capture_format/frame/material.h"
#include "passes/reference/shade.h"
#include "passes/reference/triangles.h"

namespace strata {

/// As the one of shade.h, for view-space corners at hand.
SurfacePoint surface_at(const Frame&, const RasterPoint&, const Corners&);

/// Coverage of a material at a point of its triangle, texture at mip 0: what rays test, having no pixel to filter over.
double alpha_at(const Frame&, std::uint32_t draw, std::uint32_t triangle, const glm::dvec3& barycentric);

/// Whether a surface of a masked material is there. Devices compare floats: of a material whose alpha is its cutoff, 128/255 say,
/// the double nearest to it may be below the cutoff's float.
inline bool reaches_cutoff(double alpha, const Material& material) { return float(alpha) >= material.mask_cutoff; }

/// What a mesh's surface reflects as Lambert's does, of light of any direction: base color (1 - metallic), nothing where it is
/// unlit. Textures at mip 0, as in alpha_at().
glm::dvec3 diffuse_albedo(const Frame&, std::uint32_t draw, const Attributes&);

}  // namespace strata
