// Traced shadows.
#include "passes/shadows/truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/light_types.h"
#include "passes/reference/directions.h"
#include "passes/reference/light_sets.h"
#include "passes/reference/rays.h"
#include "passes/shadows/receivers.h"
#include "passes/stage_input.h"

namespace strata {

namespace {

// Distance from its surface at which a ray starts. Positions come from float depth: wrong by 6e-8 z along the eye's ray, which a
// ray that leaves at a grazing angle of 0.1 degrees sees 600 times larger. In proportion to z alone, so in any unit of length.
double start(const Receiver& receiver) { return 1e-4 * receiver.position.z; }

// What counts as infinitely far for the sun's rays, in meters.
constexpr double sun_distance = 1e9;
// Rays to a soft light: 16 rings of equal area, 16 sectors of each, which err by some 1/256 along a straight edge.
constexpr int rings = 16, sectors = 16;

struct Ray {
    glm::dvec3 direction{0};  ///< unit
    double length = 0;        ///< to the source
};

// Middles of the parts of the unit disc, rings turned against each other so that no straight line runs through many.
std::vector<glm::dvec2> made_disc_points() {
    std::vector<glm::dvec2> points;
    for (int ring = 0; ring < rings; ++ring) {
        const double radius = std::sqrt((ring + 0.5) / rings), turn = ring * 0.6180339887498949;
        for (int sector = 0; sector < sectors; ++sector) {
            const double angle = 2 * std::numbers::pi * (sector + turn) / sectors;
            points.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
    }
    return points;
}

const std::vector<glm::dvec2>& disc_points() {
    static const std::vector<glm::dvec2> points = made_disc_points();
    return points;
}

// Uniform over the directions of a cone. `length` gives a ray's length by the cosine of its angle to the axis.
template <typename Length>
std::vector<Ray> cone_rays(const glm::dvec3& axis, double cosine, const Length& length) {
    const auto [u, v] = perpendiculars(axis);
    std::vector<Ray> rays;
    for (const glm::dvec2& point : disc_points()) {
        const double radius = glm::length(point), c = 1 - radius * radius * (1 - cosine), s = std::sqrt(1 - c * c);
        rays.push_back({c * axis + s / radius * (point.x * u + point.y * v), length(c)});
    }
    return rays;
}

// To where a light shines from: the sun's disc, a spot's disc, the sphere of other lights, or one point where it is not soft.
std::vector<Ray> rays_to(const Frame& frame, const Light& light, const glm::dvec3& position) {
    const Towards to = towards(frame, light, position);
    const bool is_sun = !has_range(light.type);
    const double radius = double(light.source_radius), distance = std::min(to.distance, sun_distance);
    if (!light.shadow.soft || (!is_sun && radius == 0)) return {{to.direction, distance}};
    if (is_sun) {
        return cone_rays(to.direction, std::cos(double(frame.sun.angular_radius)), [](double) { return sun_distance; });
    }
    if (!is_spot(light.type)) {
        if (distance <= radius) return {{to.direction, 0}};  // inside
        const double squared = radius * radius - distance * distance;
        return cone_rays(to.direction, std::sqrt(-squared) / distance, [&](double cosine) {
            return distance * cosine - std::sqrt(std::max(squared + distance * distance * cosine * cosine, 0.0));
        });
    }
    const auto [u, v] = perpendiculars(frame.view.to_view * glm::normalize(glm::dvec3(light.direction)));
    std::vector<Ray> rays;
    for (const glm::dvec2& point : disc_points()) {
        const glm::dvec3 way = to.distance * to.direction + radius * (point.x * u + point.y * v);
        rays.push_back({glm::normalize(way), glm::length(way)});
    }
    return rays;
}

// Of the light's source, as seen from the receiver.
double visible_share(const RayScene& scene, const Receiver& receiver, std::span<const Ray> rays) {
    std::size_t lit = 0;
    for (const Ray& ray : rays) {
        const double begin = start(receiver), end = ray.length - begin;
        lit += end <= begin || scene.clear(receiver.position, ray.direction, begin, end);
    }
    return double(lit) / double(rays.size());
}

}  // namespace

ImageSet shadows_truth(const StageInput& input) {
    const std::vector<std::uint32_t> shadowed = mapped_lights(input.frame);
    const auto depth = input.before.find("depth_layers");
    if (shadowed.empty() || depth == input.before.end()) return {};
    const std::vector<Light> lights = shining_lights(input.frame);
    const RayScene scene(input.frame, RayMask::shadow_casters);
    const ReferenceImage& shape = depth->second;
    const auto layers = static_cast<std::uint32_t>(shadowed.size()) * shape.layers;
    ReferenceImage visibility(shape.width, shape.height, layers, glm::dvec4(1, 0, 0, 1));
    visibility.channels = 1;
    for_each_receiver(input, [&](const Receiver& receiver) {
        for (std::uint32_t k = 0; k < shadowed.size(); ++k) {
            const std::vector<Ray> rays = rays_to(input.frame, lights[shadowed[k]], receiver.position);
            visibility.at(receiver.x, receiver.y, k * shape.layers + receiver.sample).x = visible_share(scene, receiver, rays);
        }
    });
    return {{"visibility", visibility}};
}

}  // namespace strata
