#include "passes/reference/white_radiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/light_types.h"

namespace strata {
namespace {

constexpr double pi = std::numbers::pi;

double largest(const glm::vec3& color) {
    return double(std::max(std::abs(color.x), std::max(std::abs(color.y), std::abs(color.z))));
}

/// Area that a light shows to a place before it, square meters.
double shown_area(const Light& light, LightShape shape) {
    const double r = double(light.source_radius), u = double(light.half_extent.x), v = double(light.half_extent.y);
    if (shape == LightShape::rectangle) return 2 * u * 2 * v;
    return pi * r * r + (shape == LightShape::tube ? 2 * u * 2 * r : 0);
}

/// Least and largest coordinates of what is drawn, by the boxes of its meshes.
struct Extremes {
    glm::dvec3 least{HUGE_VAL}, most{-HUGE_VAL};

    explicit Extremes(const Frame& frame) {
        for (const Draw& draw : frame.draws) {
            const std::vector<glm::vec3>& points = frame.meshes[draw.mesh].positions;
            glm::dvec3 ends[2] = {glm::dvec3(0), glm::dvec3(0)};
            if (!points.empty()) ends[0] = ends[1] = glm::dvec3(points[0]);
            for (const glm::vec3& point : points)
                ends[0] = glm::min(ends[0], glm::dvec3(point)), ends[1] = glm::max(ends[1], glm::dvec3(point));
            for (const double x : {ends[0].x, ends[1].x})
                for (const double y : {ends[0].y, ends[1].y})
                    for (const double z : {ends[0].z, ends[1].z}) {
                        const glm::dvec3 at = glm::dvec3(draw.to_world * glm::dvec4(x, y, z, 1));
                        least = glm::min(least, at), most = glm::max(most, at);
                    }
        }
    }

    /// Distance of a place from the middle, a quarter of the diagonal at least; infinite without draws.
    double distance(const glm::dvec3& place) const {
        if (!(least.x <= most.x)) return HUGE_VAL;
        const double away = std::max(glm::length(place - .5 * (least + most)), glm::length(most - least) / 4);
        return away > 0 ? away : HUGE_VAL;
    }
};

double irradiance_within(const Light& light, const Extremes& scene) {
    const LightShape shape = facts_of(light.type).shape;
    const double at_one = largest(light.intensity), distance = std::min(double(light.range) / 4, scene.distance(light.position));
    if (shape == LightShape::parallel) return at_one;
    if (!(distance > 0)) return 0;
    const double per_intensity =
        shape == LightShape::point ? 1 / (distance * distance) : std::min(pi, shown_area(light, shape) / (distance * distance));
    return at_one * per_intensity;
}

}  // namespace

double white_radiance(const Frame& frame) {
    double irradiance = largest(frame.sun.irradiance);
    if (!frame.lights.empty()) {
        const Extremes scene(frame);
        for (const Light& light : frame.lights) irradiance = std::max(irradiance, irradiance_within(light, scene));
    }
    const double fog = frame.fog.density > 0 ? largest(frame.fog.color) : 0;
    return std::max({irradiance / pi, largest(frame.hemisphere.sky), largest(frame.hemisphere.ground), fog});
}

}  // namespace strata
