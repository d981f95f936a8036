// Materials and ambient light in double, written from the formulas and not from the shaders.
#pragma once

#include <glm/glm.hpp>

#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/weather.h"
#include "passes/reference/brdf.h"
#include "passes/reference/fragments.h"

namespace strata {

/// A point of a surface with its material evaluated. View space.
struct SurfacePoint {
    glm::dvec3 position{0};
    glm::dvec3 normal{0, 0, -1};  ///< shading normal, unit, facing the eye; of hair: along the fiber, towards its tip
    glm::dvec3 base_color{1};     ///< linear
    double alpha = 1;             ///< after base color, vertex color and texture
    double metallic = 0, roughness = 1, occlusion = 1;
    glm::dvec3 emissive{0};
    glm::dvec3 transmission{0};
    LightingModel model = LightingModel::ggx;
};

/// The material at a raster point: attributes interpolated, textures sampled (bilinear and trilinear in double; the level
/// of detail from the uv derivatives of the triangle's plane at that pixel, as passes/shaders/material.glsl defines it).
SurfacePoint surface_at(const Frame&, const RasterPoint&);

/// The sun as a light, or nothing in its irradiance.
Light sun_light(const Frame&);
/// Light from the hemisphere, times occlusion: albedo (1 - metallic) mix(ground, sky, .5 + .5 n_world.y), and what metals mirror
/// of sky and ground through the lobe of linearly transformed cosines.
glm::dvec3 hemisphere_light(const Frame&, const SurfacePoint&);

/// Meters of fog before a point in view space.
double fog_way(FogPath, const glm::dvec3& position);

/// Remaining share and added radiance of so many meters of fog.
struct FogAt {
    double remains = 1;
    glm::dvec3 added{0};
};
FogAt fog_at(const Frame&, double meters);

/// World position to view space.
glm::dvec3 to_view(const Frame&, const glm::dvec3& world);
/// Where a view-space ray through a sample of a pixel goes, z = 1 (docs/algorithms/lighting.md 0.1). Sample offsets: deferred
/// 0.4.
glm::dvec3 pixel_ray(const Frame&, double px, double py);
/// Position of a sample within its pixel, 0..1; (.5, .5) at one sample.
glm::dvec2 sample_position(std::uint32_t samples, std::uint32_t sample);

}  // namespace strata
