#include "passes/scene/transparent_depths.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "passes/scene/view_space.h"
#include "passes/shaders/ordering.shared.h"

namespace strata {
namespace {

struct Range {
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    void take(double z, double near) {
        nearest = std::min(nearest, std::max(z, near));
        farthest = std::max(farthest, z);
    }
};

void take_vertices(Range& range, const Frame& frame, const Draw& draw) {
    for (const glm::vec3& position : frame.meshes[draw.mesh].positions) {
        const glm::dvec3 world(draw.to_world * glm::dvec4(glm::dvec3(position), 1));
        range.take(in_view_space(frame.view, world).z, double(frame.view.near));
    }
}

void take_particles(Range& range, const Frame& frame, const Emitter& emitter) {
    const double near = double(frame.view.near);
    for (const Particle& particle : emitter.particles) {
        const double z = in_view_space(frame.view, particle.center).z;
        if (z > near && std::isfinite(particle.depth_offset)) range.take(z - double(particle.depth_offset), near);
    }
}

}  // namespace

DepthRange depths_with_layers(const Frame& frame, const DrawLists& lists, DepthRange range) {
    const std::uint32_t highest = highest_interface_layer(frame, lists);
    if (highest > 0) range.nearest = std::min(range.nearest, layer_depth(frame.view.near, highest));
    return range;
}

DepthRange world_depths(const Frame& frame, const DrawLists& lists) {
    Range range;
    for (const std::uint32_t index : lists.transparent) {
        if (interface_layer(frame, index) > 0) continue;
        if (index < frame.draws.size()) take_vertices(range, frame, frame.draws[index]);
        else take_particles(range, frame, frame.emitters[index - frame.draws.size()]);
    }
    const double near = double(frame.view.near);
    if (range.farthest <= near) return {frame.view.near, 2 * frame.view.near};
    // Flat geometry has no range of its own.
    return {static_cast<float>(range.nearest), static_cast<float>(std::max(range.farthest, range.nearest * 1.001))};
}

float farthest_depth_offset(const Frame& frame) {
    float offset = 0;
    for (const Emitter& emitter : frame.emitters)
        for (const Particle& particle : emitter.particles)
            if (std::isfinite(particle.depth_offset)) offset = std::max(offset, particle.depth_offset);
    return offset;
}

}  // namespace strata
