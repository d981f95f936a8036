#include "passes/scene/light_records.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/scene/light_blockers.h"
#include "passes/scene/light_features.h"
#include "passes/scene/view_space.h"

namespace strata {
namespace {

vec2 tangents(const Light& light) {
    const double u = std::tan(double(light.outer_angle));
    const bool square = facts_of(light.type).cone == LightCone::square;
    return {float(u), float(square ? std::tan(double(light.inner_angle)) : u)};
}

LightRecord record(const Frame& frame, const Light& light) {
    return {
        .position = glm::vec3(in_view_space(frame.view, light.position)),
        .type = static_cast<uint>(light.type),
        .direction = glm::vec3(frame.view.to_view * glm::dvec3(light.direction)),
        .range = light.range,
        .intensity = light.intensity,
        .source_radius = light.source_radius,
        .axis_u = glm::vec3(frame.view.to_view * glm::dvec3(light.axis_u)),
        .cos_inner = float(std::cos(double(light.inner_angle))),
        .cos_outer = float(std::cos(double(light.outer_angle))),
        .tan_half = is_spot(light.type) ? tangents(light) : vec2(0),
        .half_extent = light.half_extent,
        .texture = light.texture,
        .features = light_features(light),
        .shadow = no_index,
        .shadow_slots = 0,
        .visibility_layer = no_index,
        .window = static_cast<uint>(light.window),
    };
}

// Keeps dot(n, p) + d >= 0 with p camera-relative.
void add_clip_planes(const Frame& frame, const Light& light, LightRecords& made) {
    made.lights.back().first_clip = static_cast<uint>(made.clip_planes.size());
    made.lights.back().clips = static_cast<uint>(light.clip_planes.size());
    for (const ClipPlane& plane : light.clip_planes) {
        const double distance = plane.distance + glm::dot(plane.normal, frame.view.origin);
        made.clip_planes.push_back({glm::vec3(frame.view.to_view * plane.normal), float(distance)});
    }
}

void add_blockers(const LightBlockerRecords& found, LightRecords& made) {
    LightRecord& light = made.lights.back();
    light.first_blocker = static_cast<uint>(made.light_blockers.size());
    light.blockers = static_cast<uint>(found.blockers.size());
    light.first_portal = static_cast<uint>(made.blocker_portals.size());
    light.portals = static_cast<uint>(found.portals.size());
    std::ranges::copy(found.blockers, std::back_inserter(made.light_blockers));
    std::ranges::copy(found.portals, std::back_inserter(made.blocker_portals));
}

}  // namespace

LightRecords light_records(const Frame& frame, std::span<const Light> lights) {
    LightRecords made;
    made.blockers = blocker_records(frame);
    made.portals = portal_records(frame);
    for (const Light& light : lights) {
        made.lights.push_back(record(frame, light));
        add_clip_planes(frame, light, made);
        add_blockers(light_blocker_records(frame, light), made);
    }
    return made;
}

}  // namespace strata
