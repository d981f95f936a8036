// The samples of the G-buffer as receivers of shadow.
#include "passes/shadows/receivers.h"

#include <limits>

#include <tbb/parallel_for.h>

#include "capture_format/frame/frame.h"
#include "capture_format/light_types.h"
#include "passes/reference/shade.h"
#include "passes/stage_input.h"

namespace strata {

namespace {

void visit_row(const StageInput& input, std::uint32_t y, const std::function<void(const Receiver&)>& visit) {
    const ReferenceImage& depth = input.before.at("depth_layers");
    const auto normals = input.before.find("surface_normal"), materials = input.before.find("surface_material");
    for (std::uint32_t sample = 0; sample < depth.layers; ++sample) {
        const glm::dvec2 offset = sample_position(depth.layers, sample);
        for (std::uint32_t x = 0; x < depth.width; ++x) {
            const double device_depth = depth.at(x, y, sample).x;
            if (!(device_depth > 0)) continue;
            Receiver receiver{x, y, sample};
            receiver.position =
                pixel_ray(input.frame, x + offset.x, y + offset.y) * (double(input.frame.view.near) / device_depth);
            if (normals != input.before.end()) {
                SurfacePoint point;
                point.position = receiver.position;
                point.normal = glm::dvec3(normals->second.at(x, y, sample));
                if (materials != input.before.end())
                    point.model = static_cast<LightingModel>(static_cast<std::uint32_t>(materials->second.at(x, y, sample).x));
                receiver.normal = facing_normal(point);
            }
            visit(receiver);
        }
    }
}

}  // namespace

void for_each_receiver(const StageInput& input, const std::function<void(const Receiver&)>& visit) {
    tbb::parallel_for(0u, input.before.at("depth_layers").height, [&](std::uint32_t y) { visit_row(input, y, visit); });
}

Towards towards(const Frame& frame, const Light& light, const glm::dvec3& position) {
    if (!has_range(light.type)) {
        return {-(frame.view.to_view * glm::normalize(glm::dvec3(light.direction))), std::numeric_limits<double>::infinity()};
    }
    const glm::dvec3 offset = to_view(frame, light.position) - position;
    const double distance = glm::length(offset);
    return {offset / distance, distance};
}

}  // namespace strata
