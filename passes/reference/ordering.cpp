#include "passes/reference/ordering.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "passes/reference/fragments.h"
#include "passes/reference/shade.h"
#include "passes/reference/triangles.h"
#include "passes/shaders/ordering.shared.h"

namespace strata {
namespace {

const Emitter* emitter_of(const Frame& frame, std::uint32_t draw) {
    return draw < frame.draws.size() ? nullptr : &frame.emitters[draw - frame.draws.size()];
}

/// Middle of the box around the places.
glm::dvec3 middle_of(const std::vector<glm::dvec3>& places) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::dvec3& place : places) low = glm::min(low, place), high = glm::max(high, place);
    return places.empty() ? glm::dvec3(0) : (low + high) * .5;
}

/// View depth that a painter sorts an object by.
double painters_depth(const Frame& frame, std::uint32_t draw) {
    std::vector<glm::dvec3> places;
    if (const Emitter* emitter = emitter_of(frame, draw)) {
        for (const Particle& particle : emitter->particles) places.push_back(particle.center);
        return to_view(frame, middle_of(places)).z;
    }
    const Draw& object = frame.draws[draw];
    for (const glm::vec3& position : frame.meshes[object.mesh].positions) places.emplace_back(position);
    return to_view(frame, glm::dvec3(object.to_world * glm::dvec4(middle_of(places), 1))).z;
}

/// Places of keys in ascending order; equal keys stay as they were.
template <typename Key>
std::vector<std::uint32_t> in_ascending_order(const std::vector<Key>& keys) {
    std::vector<std::uint32_t> order(keys.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
    return order;
}

}  // namespace

std::uint32_t layer_of(const Frame& frame, std::uint32_t draw) {
    return draw < frame.draws.size() ? frame.draws[draw].layer : frame.emitters[draw - frame.draws.size()].layer;
}

std::uint32_t highest_layer(const Frame& frame) {
    std::uint32_t highest = 0;
    for (const std::uint32_t draw : transparent_draws(frame)) highest = std::max(highest, layer_of(frame, draw));
    return highest;
}

double ordering_depth(const Frame& frame, std::uint32_t layer, double z) {
    const float near = frame.view.near;
    return layer > 0 ? double(layer_depth(near, layer)) : std::max(z, double(near));
}

DepthRange transparent_depth_range(const Frame& frame) {
    DepthRange range = world_depth_range(frame);
    const std::uint32_t layer = highest_layer(frame);
    if (layer > 0) range.nearest = std::min(range.nearest, static_cast<float>(ordering_depth(frame, layer, 0)));
    return range;
}

DepthRange world_depth_range(const Frame& frame) {
    const double near = double(frame.view.near);
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    const auto reach = [&](double z) {
        nearest = std::min(nearest, std::max(z, near));
        farthest = std::max(farthest, z);
    };
    for (const std::uint32_t draw : transparent_draws(frame)) {
        if (layer_of(frame, draw) > 0) continue;
        if (const Emitter* emitter = emitter_of(frame, draw)) {
            for (const Particle& particle : emitter->particles)
                if (const double z = to_view(frame, particle.center).z; z > near && std::isfinite(particle.depth_offset))
                    reach(z - double(particle.depth_offset));
            continue;
        }
        const DrawSpace space = draw_space(frame, draw);
        for (const glm::vec3& position : frame.meshes[frame.draws[draw].mesh].positions)
            reach((space.linear * glm::dvec3(position) + space.offset).z);
    }
    if (farthest <= near) return {frame.view.near, 2 * frame.view.near};
    return {float(nearest), float(std::max(farthest, nearest * 1.001))};  // flat geometry has no range of its own
}

std::vector<std::uint32_t> painters_order(const Frame& frame) {
    std::vector<std::uint32_t> listed;
    std::vector<std::pair<std::pair<std::uint32_t, std::int32_t>, double>> keys;
    for (const std::uint32_t draw : transparent_draws(frame)) {
        const Emitter* emitter = emitter_of(frame, draw);
        if (emitter && emitter->particles.empty()) continue;
        const std::uint32_t layer = layer_of(frame, draw);
        const std::int32_t priority = emitter ? emitter->sort_priority : frame.draws[draw].sort_priority;
        listed.push_back(draw);
        keys.push_back({{layer, priority}, layer > 0 ? 0 : -painters_depth(frame, draw)});
    }
    std::vector<std::uint32_t> order;
    for (const std::uint32_t place : in_ascending_order(keys)) order.push_back(listed[place]);
    return order;
}

std::vector<std::uint32_t> painters_order(const Frame& frame, const Emitter& emitter) {
    std::vector<double> keys;
    for (const Particle& particle : emitter.particles) {
        const double offset = std::isfinite(particle.depth_offset) ? double(particle.depth_offset) : 0;
        keys.push_back(emitter.layer > 0 ? 0 : offset - to_view(frame, particle.center).z);
    }
    return in_ascending_order(keys);
}

}  // namespace strata
