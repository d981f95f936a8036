// Reflectance of the lighting models in double, written from the papers and not from the shaders
// (docs/algorithms/lighting.md 0.5).
#pragma once

#include <glm/glm.hpp>

namespace strata {

struct SurfacePoint;

/// Smallest width of a GGX lobe: below it points' highlights alias anyway (docs/algorithms/lighting.md 0.5).
inline constexpr double smallest_lobe = 0.002;
/// Smallest cosine of the eye: it keeps the visibility term finite where a mapped normal leans away.
inline constexpr double smallest_cosine = 1e-4;

/// f(l, v) per steradian for unit vectors, the eye on the normal's side; times brdf_cosine() it is the radiance of one unit of
/// irradiance. Reciprocal: lambert, burley, plain_burley, ggx, cloth, hair.
glm::dvec3 brdf(const SurfacePoint&, glm::dvec3 to_light, glm::dvec3 to_eye);

/// The cosine that irradiance comes in by: 0 from behind, but for skin, which light wraps around, and for hair, where it is the
/// sine between light and fiber.
double brdf_cosine(const SurfacePoint&, const glm::dvec3& to_light);

/// The normal, or of hair, whose `normal` is the fiber, the one that faces the eye at the origin.
glm::dvec3 facing_normal(const SurfacePoint&);

/// Burley's diffuse lobe relative to Lambert: plain, and with Frostbite's energy bias and factor. Cosines in 0..1.
double burley(double roughness, double n_l, double n_v, double l_h);
double renormalized_burley(double roughness, double n_l, double n_v, double l_h);

/// The fits of passes/shaders/albedo_fits.shared.h: what GGX with a Fresnel term of 1, the same with one of (1 - l.h)^5, and the
/// sheen of cloth reflect of a uniform sky towards an eye at a cosine in 1e-4..1.
double fitted_ggx_albedo(double cosine, double alpha);
double fitted_ggx_grazing(double cosine, double roughness);
double fitted_sheen_albedo(double cosine, double alpha);

}  // namespace strata
