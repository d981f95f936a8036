#include "passes/scene/object_order.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "passes/scene/draw_lists.h"
#include "passes/scene/view_space.h"

namespace strata {
namespace {

double view_depth(const Frame& frame, const glm::dvec3& world) { return in_view_space(frame.view, world).z; }

/// Middle of the box around the points, or the origin of nothing.
template <typename Element, typename Point>
glm::dvec3 box_center(std::span<const Element> elements, Point point) {
    if (elements.empty()) return glm::dvec3(0);
    glm::dvec3 low = point(elements.front()), high = low;
    for (const Element& element : elements) {
        low = glm::min(low, point(element));
        high = glm::max(high, point(element));
    }
    return (low + high) * .5;
}

struct SortedObject {
    std::uint32_t draw = 0, layer = 0;
    std::int32_t priority = 0;
    double depth = 0;  ///< 0 in an interface layer: submission decides there
};

SortedObject sorted_object(const Frame& frame, std::uint32_t index) {
    const std::uint32_t layer = interface_layer(frame, index);
    const auto depth_of = [&](const glm::dvec3& center) { return layer > 0 ? 0 : view_depth(frame, center); };
    if (index < frame.draws.size()) {
        const Draw& draw = frame.draws[index];
        const std::span<const glm::vec3> positions = frame.meshes[draw.mesh].positions;
        const glm::dvec3 center = box_center(positions, [](const glm::vec3& p) { return glm::dvec3(p); });
        return {index, layer, draw.sort_priority, depth_of(glm::dvec3(draw.to_world * glm::dvec4(center, 1)))};
    }
    const Emitter& emitter = frame.emitters[index - frame.draws.size()];
    const std::span<const Particle> particles = emitter.particles;
    const glm::dvec3 center = box_center(particles, [](const Particle& p) { return p.center; });
    return {index, layer, emitter.sort_priority, depth_of(center)};
}

}  // namespace

std::vector<std::uint32_t> back_to_front_draws(const Frame& frame) {
    std::vector<SortedObject> objects;
    for (const std::uint32_t index : draw_lists(frame).transparent)
        if (index < frame.draws.size() || !frame.emitters[index - frame.draws.size()].particles.empty())
            objects.push_back(sorted_object(frame, index));
    // Stable: equal objects keep the order of submission.
    std::ranges::stable_sort(objects, [](const SortedObject& a, const SortedObject& b) {
        return std::tuple(a.layer, a.priority, b.depth) < std::tuple(b.layer, b.priority, a.depth);
    });
    std::vector<std::uint32_t> order;
    for (const SortedObject& object : objects) order.push_back(object.draw);
    return order;
}

std::vector<std::uint32_t> back_to_front_particles(const Frame& frame, const Emitter& emitter) {
    const auto depth_of = [&](const Particle& particle) {
        const double center = view_depth(frame, particle.center);
        return std::isfinite(particle.depth_offset) ? center - double(particle.depth_offset) : center;
    };
    std::vector<double> depths;
    for (const Particle& particle : emitter.particles) depths.push_back(emitter.layer > 0 ? 0 : depth_of(particle));
    std::vector<std::uint32_t> order(depths.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return depths[a] > depths[b]; });
    return order;
}

}  // namespace strata
