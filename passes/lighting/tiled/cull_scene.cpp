#include "passes/lighting/tiled/cull_scene.h"

#include <cmath>

#include "passes/reference/blockers.h"
#include "passes/reference/shade.h"
#include "passes/shadows/shadow_views.h"

namespace strata::lighting {
namespace {

ViewRecord view_record(const View& v) {
    return {.ndc_scale = {v.projection[0][0], -v.projection[1][1]},
            .ndc_offset = {v.projection[2][0] + v.jitter.x, -(v.projection[2][1] + v.jitter.y)},
            .extent = {v.width, v.height}};
}

glm::vec3 turned(const Frame& frame, const glm::vec3& direction) { return glm::vec3(frame.view.to_view * glm::dvec3(direction)); }

void add_clip_planes(const Frame& frame, const Light& light, CullScene& scene) {
    for (const ClipPlane& plane : light.clip_planes) {
        const double at_eye = glm::dot(plane.normal, frame.view.origin) + plane.distance;
        scene.clip_planes.push_back({glm::vec3(frame.view.to_view * plane.normal), float(at_eye)});
    }
}

void add_blockers(const LightBlockers& found, CullScene& scene) {
    for (const LightBlocker& use : found.blockers) {
        const PlacedBlocker& b = use.shape;
        scene.light_blockers.push_back({static_cast<uint>(use.blocker), use.portals});
        scene.blockers[use.blocker] = {glm::vec3(b.normal), float(b.half_u), glm::vec3(b.center),
                                       float(b.half_v),     glm::vec3(b.u),  b.one_sided ? 1u : 0u};
    }
    for (const PlacedPortal& p : found.portals)
        scene.blocker_portals.push_back({glm::vec2(p.center), glm::vec2(p.half_extent), glm::vec2(p.turn), p.blocker});
}

void add_light(const Frame& frame, const Light& light, CullScene& scene) {
    const LightBlockers found = light_blockers(frame, light);
    scene.lights.push_back({.position = glm::vec3(to_view(frame, light.position)),
                            .type = static_cast<uint>(light.type),
                            .direction = turned(frame, light.direction),
                            .range = light.range,
                            .intensity = light.intensity,
                            .axis_u = turned(frame, light.axis_u),
                            .cos_outer = float(std::cos(double(light.outer_angle))),
                            .tan_half = {float(std::tan(double(light.outer_angle))), float(std::tan(double(light.inner_angle)))},
                            .first_blocker = static_cast<uint>(scene.light_blockers.size()),
                            .blockers = static_cast<uint>(found.blockers.size()),
                            .first_portal = static_cast<uint>(scene.blocker_portals.size()),
                            .portals = static_cast<uint>(found.portals.size()),
                            .first_clip = static_cast<uint>(scene.clip_planes.size()),
                            .clips = static_cast<uint>(light.clip_planes.size()),
                            .visibility_layer = no_index});
    add_blockers(found, scene);
    add_clip_planes(frame, light, scene);
}

}  // namespace

CullScene cull_scene(const Frame& frame) {
    CullScene scene{.view = view_record(frame.view)};
    scene.blockers.resize(frame.blockers.size());
    for (const Light& light : shadow_lights(frame)) add_light(frame, light, scene);
    return scene;
}

}  // namespace strata::lighting
