#include "passes/reference/brdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "passes/reference/shade.h"
#include "passes/shaders/albedo_fits.shared.h"

namespace strata {
namespace {

using std::numbers::pi;
// Reflectance of skin and hair at normal incidence: refraction of 1.4 and of 1.55.
constexpr double skin_f0 = 0.028, hair_f0 = 0.0465;

double saturate(double x) { return std::clamp(x, 0.0, 1.0); }

double alpha_of(double roughness) { return std::max(roughness * roughness, smallest_lobe); }

/// The cosines between normal n, light l, eye v and h halfway between these.
struct Cosines {
    Cosines(const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v) : n_l(glm::dot(n, l)), n_v(glm::dot(n, v)) {
        const double size = glm::length(l + v);
        if (size == 0) return;
        n_h = saturate((n_l + n_v) / size);
        l_h = saturate(size / 2);
    }
    double n_l, n_v, n_h = 0, l_h = 0;
};

glm::dvec3 fresnel(const glm::dvec3& f0, double cosine) { return f0 + (1.0 - f0) * std::pow(1 - saturate(cosine), 5); }

/// D V of Walter et al. 2007 and Heitz 2014.
double ggx(const Cosines& c, double alpha) {
    const double n_l = std::max(c.n_l, smallest_cosine), n_v = std::max(c.n_v, smallest_cosine), a2 = alpha * alpha;
    const double d = a2 / (pi * std::pow(c.n_h * c.n_h * (a2 - 1) + 1, 2));
    return d * 0.5 / (n_l * std::sqrt(n_v * n_v * (1 - a2) + a2) + n_v * std::sqrt(n_l * n_l * (1 - a2) + a2));
}

double polynomial(const vec4 (&fit)[6], double s, double alpha) {
    double sum = 0, factor = 1;
    for (const vec4& row : fit) {
        sum += factor * (double(row.x) + alpha * double(row.y) + alpha * alpha * (double(row.z) + alpha * double(row.w)));
        factor *= s;
    }
    return sum;
}

/// What GGX of an F0 reflects of a uniform sky: Karis 2013's split into a part that F0 scales and a part that it leaves.
double ggx_sky(double n_v, double roughness, double f0) {
    const double all = std::min(fitted_ggx_albedo(n_v, alpha_of(roughness)), 1.0), grazing = fitted_ggx_grazing(n_v, roughness);
    return f0 * (all - grazing) + grazing;
}

/// What light does at a surface of base color and metals: the models that are not of one stuff.
glm::dvec3 layered(const SurfacePoint& surface, const Cosines& c) {
    const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), surface.base_color, surface.metallic);
    const double n_l = saturate(c.n_l), n_v = std::clamp(c.n_v, smallest_cosine, 1.0);
    const glm::dvec3 specular = ggx(c, alpha_of(surface.roughness)) * fresnel(f0, c.l_h);
    glm::dvec3 diffuse = surface.base_color * ((1 - surface.metallic) / pi);
    if (surface.model == LightingModel::burley) diffuse *= renormalized_burley(surface.roughness, n_l, n_v, c.l_h);
    if (surface.model == LightingModel::plain_burley) diffuse *= burley(surface.roughness, n_l, n_v, c.l_h);
    if (surface.model != LightingModel::multiscatter_ggx) return diffuse + specular;
    // Turquin 2019: what one bounce loses comes out after more of them, colored once more by F0. Lambert gets what is left.
    const glm::dvec3 bounces = 1.0 + f0 * (1 / ggx_sky(n_v, surface.roughness, 1) - 1);
    const glm::dvec3 highlight =
        bounces * glm::dvec3(ggx_sky(n_v, surface.roughness, f0.x), ggx_sky(n_v, surface.roughness, f0.y),
                             ggx_sky(n_v, surface.roughness, f0.z));
    return diffuse * (1.0 - highlight) + specular * bounces;
}

/// Estevez and Kulla 2017 over Lambert, with the visibility of Neubelt and Pettineo 2013.
glm::dvec3 cloth(const SurfacePoint& surface, const Cosines& c) {
    const double alpha = 0.25 + 0.75 * surface.roughness, sine = std::sqrt(std::max(1 - c.n_h * c.n_h, 1e-12));
    const double n_l = std::clamp(c.n_l, smallest_cosine, 1.0), n_v = std::clamp(c.n_v, smallest_cosine, 1.0);
    const double d = (2 + 1 / alpha) / (2 * pi) * std::pow(sine, 1 / alpha);
    const glm::dvec3 tint = glm::sqrt(glm::max(surface.base_color, glm::dvec3(0)));
    const glm::dvec3 below = (1.0 - tint * fitted_sheen_albedo(n_l, alpha)) * (1.0 - tint * fitted_sheen_albedo(n_v, alpha));
    return tint * d / (4 * (n_l + n_v - n_l * n_v)) + surface.base_color / pi * below;
}

/// Cosines by which red, green and blue wrap around skin: as the mean free paths of Jensen et al. 2001, red by 0.4.
glm::dvec3 skin_wrap() { return glm::dvec3(3.67, 1.37, 0.68) * (0.4 / 3.67); }

/// The cosine of the color that wraps farthest.
double skin_cosine(double n_l) { return std::max(n_l + skin_wrap().x, 0.0) / (1 + skin_wrap().x); }

/// Two lobes over the wrapped diffuse of McAuley 2011. What is returned is over brdf_cosine(), so that the product is exact.
glm::dvec3 skin(const SurfacePoint& surface, const Cosines& c) {
    const glm::dvec3 wrap = skin_wrap(), f0(skin_f0);
    const glm::dvec3 lit = glm::max(c.n_l + wrap, glm::dvec3(0)) / ((1.0 + wrap) * (1.0 + wrap));
    const double sharp = ggx(c, alpha_of(0.75 * surface.roughness)),
                 wide = ggx(c, alpha_of(std::min(1.3 * surface.roughness, 1.0)));
    const glm::dvec3 mirrored = (0.85 * sharp + 0.15 * wide) * std::max(c.n_l, 0.0) * fresnel(f0, c.l_h);
    const double reflected = ggx_sky(std::clamp(c.n_v, smallest_cosine, 1.0), 0.75 * surface.roughness, skin_f0);
    const glm::dvec3 scattered = surface.base_color / pi * (1 - reflected) * lit;
    return (mirrored + scattered) / std::max(skin_cosine(c.n_l), smallest_cosine);
}

double normal_distribution(double x, double deviation) {
    return std::exp(-0.5 * std::pow(x / deviation, 2)) / (deviation * std::sqrt(2 * pi));
}

/// Kajiya and Kay 1989 with the highlights of Scheuermann 2004. The angle around the fiber is made from what is across it: near
/// pi its cosine would hold half the digits.
glm::dvec3 hair(const SurfacePoint& surface, const glm::dvec3& to_light, const glm::dvec3& to_eye) {
    const glm::dvec3& fiber = surface.normal;
    const double sine_l = glm::dot(fiber, to_light), sine_v = glm::dot(fiber, to_eye);
    const glm::dvec3 light_across = to_light - sine_l * fiber, eye_across = to_eye - sine_v * fiber;
    const double azimuth = std::atan2(glm::length(glm::cross(light_across, eye_across)), glm::dot(light_across, eye_across));
    const double around = std::cos(azimuth / 2) / 4, deviation = std::max(surface.roughness * surface.roughness, 0.01);
    const double white = normal_distribution(sine_l + sine_v + 0.07, deviation);
    const double colored = normal_distribution(sine_l + sine_v - 0.14, 2 * deviation);
    const glm::dvec3 mirrored = fresnel(glm::dvec3(hair_f0), glm::length(to_light + to_eye) / 2);
    const double inside = 0.25 * colored * around, diffuse = 0.75 / (pi * pi);
    return mirrored * white * around + (1.0 - mirrored) * surface.base_color * (inside + diffuse);
}

}  // namespace

double burley(double roughness, double n_l, double n_v, double l_h) {
    const double f90 = 0.5 + 2 * roughness * l_h * l_h;
    return (1 + (f90 - 1) * std::pow(1 - n_l, 5)) * (1 + (f90 - 1) * std::pow(1 - n_v, 5));
}

double renormalized_burley(double roughness, double n_l, double n_v, double l_h) {
    const double f90 = 0.5 * roughness + 2 * roughness * l_h * l_h;
    const double scatter = (1 + (f90 - 1) * std::pow(1 - n_l, 5)) * (1 + (f90 - 1) * std::pow(1 - n_v, 5));
    return std::lerp(1.0, 1 / 1.51, roughness) * scatter;
}

double fitted_ggx_albedo(double cosine, double alpha) { return polynomial(ggx_albedo_fit, cosine / (cosine + alpha), alpha); }

double fitted_ggx_grazing(double cosine, double roughness) {
    const double rough = std::max(roughness, 0.1), from = std::max(cosine, 0.002);
    return polynomial(ggx_fresnel_fit, from / (from + rough * rough), rough) * std::pow(1 - cosine, 5);
}

double fitted_sheen_albedo(double cosine, double alpha) { return polynomial(sheen_albedo_fit, std::sqrt(cosine), alpha); }

glm::dvec3 brdf(const SurfacePoint& surface, glm::dvec3 to_light, glm::dvec3 to_eye) {
    const Cosines cosines(surface.normal, to_light, to_eye);
    switch (surface.model) {
        case LightingModel::unlit:
            return glm::dvec3(0);
        case LightingModel::lambert:
            return surface.base_color / pi;
        case LightingModel::cloth:
            return cloth(surface, cosines);
        case LightingModel::skin:
            return skin(surface, cosines);
        case LightingModel::hair:
            return hair(surface, to_light, to_eye);
        case LightingModel::burley:
        case LightingModel::ggx:
        case LightingModel::plain_burley:
        case LightingModel::multiscatter_ggx:
            break;
    }
    return layered(surface, cosines);
}

double brdf_cosine(const SurfacePoint& surface, const glm::dvec3& to_light) {
    const double cosine = glm::dot(surface.normal, to_light);
    if (surface.model == LightingModel::skin) return skin_cosine(cosine);
    if (surface.model == LightingModel::hair) return glm::length(glm::cross(surface.normal, to_light));
    return saturate(cosine);
}

glm::dvec3 facing_normal(const SurfacePoint& surface) {
    if (surface.model != LightingModel::hair) return surface.normal;
    const glm::dvec3 to_eye = glm::normalize(-surface.position);
    const glm::dvec3 aside = to_eye - surface.normal * glm::dot(surface.normal, to_eye);
    return glm::length(aside) > 1e-4 ? glm::normalize(aside) : to_eye;
}

}  // namespace strata
