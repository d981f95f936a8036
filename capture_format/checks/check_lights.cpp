// The lights of check_frame(). Directions must be unit where a formula relies on it: an omni light's may be anything finite.
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/inspection.h"
#include "capture_format/light_types.h"

namespace strata {
namespace {

constexpr double half_pi = 1.57079633;      // rounded up: a float's pi / 2 passes
constexpr double widest_projection = 1.55;  // 88.8 degrees: the tangent of a projected spot's half angle stays below 50
constexpr std::size_t most_clip_planes = 6, most_blockers = 32, most_portals = 32;
constexpr std::uint32_t most_cascades = 8, most_cells = 256, most_iterations = 1024;

void inspect_shadow(Inspection& inspection, const ShadowUse& shadow) {
    inspection.expect_within("shadow map size in texels", shadow.map_size, 1, largest_extent);
    inspection.expect_finite("shadow's bias", shadow.bias);
}

/// Spots that look through a projection: a square one, one with a picture, one with a shadow map.
bool projects(const Light& light) {
    const LightCone cone = facts_of(light.type).cone;
    return cone == LightCone::square || (cone == LightCone::round && (light.texture != no_index || light.shadow.casts));
}

void inspect_directions(Inspection& inspection, const Light& light) {
    const LightShape shape = facts_of(light.type).shape;
    if (has_direction(light.type)) inspection.expect_unit("direction", light.direction);
    if (shape == LightShape::tube) inspection.expect_unit("tube's axis_u", light.axis_u);
    if (projects(light) || shape == LightShape::rectangle) {
        inspection.expect_unit("axis_u", light.axis_u);
        inspection.expect_perpendicular("axis_u", "direction", light.axis_u, light.direction);
    }
}

void inspect_angles(Inspection& inspection, const Light& light) {
    inspection.expect_finite("inner half angle", light.inner_angle);
    inspection.expect_finite("outer half angle", light.outer_angle);
    if (!is_spot(light.type)) return;
    const double widest = projects(light) ? widest_projection : half_pi;
    inspection.expect_positive("outer half angle in radians", light.outer_angle);
    inspection.expect_within("outer half angle in radians", light.outer_angle, 0, widest);
    const double inner_limit = facts_of(light.type).cone == LightCone::round ? light.outer_angle : widest;
    inspection.expect_within("inner half angle in radians", light.inner_angle, 0, inner_limit);
}

void inspect_indices(Inspection& inspection, const Frame& frame, const Light& light) {
    inspection.expect_at_most("clip planes", light.clip_planes.size(), most_clip_planes);
    for (const ClipPlane& plane : light.clip_planes) {
        inspection.expect_unit("clip plane's normal", plane.normal);
        inspection.expect_finite("clip plane's distance", plane.distance);
    }
    inspection.expect_at_most("blockers", light.blockers.size(), most_blockers);
    for (const std::uint32_t blocker : light.blockers) {
        inspection.expect_index("blocker", blocker, frame.blockers.size());
    }
    inspection.expect_at_most("portals", light.portals.size(), most_portals);
    for (const std::uint32_t portal : light.portals) {
        inspection.expect_index("portal", portal, frame.portals.size());
    }
}

void inspect_light(Inspection& inspection, const Frame& frame, const Light& light) {
    inspection.expect_name(light.name);
    inspection.expect_known("light type", light.type, last_light_type);
    inspection.expect_known("range window", light.window, RangeWindow::quartic);
    inspection.expect_finite("position", light.position);
    inspection.expect_finite("direction", light.direction);
    inspection.expect_finite("axis_u", light.axis_u);
    inspection.expect_finite("intensity", light.intensity);
    inspection.expect_not_negative("range in meters", light.range);
    inspection.expect_not_negative("source radius in meters", light.source_radius);
    inspection.expect_not_negative("half extent x in meters", light.half_extent.x);
    inspection.expect_not_negative("half extent y in meters", light.half_extent.y);
    inspect_directions(inspection, light);
    inspect_angles(inspection, light);
    inspect_shadow(inspection, light.shadow);
    inspect_indices(inspection, frame, light);
}

/// Blockers and portals are the same rectangle.
template <typename Rectangle>
void inspect_rectangle(Inspection& inspection, const Rectangle& rectangle) {
    inspection.expect_finite("center", rectangle.center);
    inspection.expect_unit("u", rectangle.u);
    inspection.expect_unit("v", rectangle.v);
    inspection.expect_perpendicular("v", "u", rectangle.u, rectangle.v);
    inspection.expect_not_negative("half_u in meters", rectangle.half_u);
    inspection.expect_not_negative("half_v in meters", rectangle.half_v);
}

void inspect_sun(Inspection& inspection, const Sun& sun) {
    inspection.expect_unit("direction", sun.direction);
    inspection.expect_finite("irradiance", sun.irradiance);
    inspection.expect_within("angular radius in radians", sun.angular_radius, 0, half_pi);
    inspection.expect_within("number of cascades", sun.cascades, 1, most_cascades);
    inspection.expect_positive("shadow distance in meters", sun.shadow_distance);
    inspect_shadow(inspection, sun.shadow);
}

void inspect_volume(Inspection& inspection, const LightVolume& volume) {
    inspection.expect_known("volume kind", volume.kind, VolumeKind::fixed_local);
    inspection.expect_known("volume occlusion", volume.occlusion, VolumeOcclusion::axial);
    inspection.expect_finite("center", volume.center);
    for (int i = 0; i < 3; ++i) {
        inspection.expect_positive("half extent in meters", volume.half_extent[i]);
        inspection.expect_within("number of cells each way", volume.cells[i], 1, most_cells);
    }
    inspection.expect_within("number of cascades", volume.cascades, 1, most_cascades);
    inspection.expect_within("number of iterations", volume.iterations, 0, most_iterations);
}

}  // namespace

void inspect_lights(Inspection& inspection, const Frame& frame, std::size_t textures) {
    for (std::size_t i = 0; i < frame.blockers.size(); ++i) {
        inspection.at({.kind = "blocker", .index = i});
        inspect_rectangle(inspection, frame.blockers[i]);
    }
    for (std::size_t i = 0; i < frame.portals.size(); ++i) {
        inspection.at({.kind = "portal", .index = i});
        inspect_rectangle(inspection, frame.portals[i]);
        inspection.expect_index("blocker", frame.portals[i].blocker, frame.blockers.size());
    }
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        inspection.at({"light", i, frame.lights[i].name});
        inspect_light(inspection, frame, frame.lights[i]);
        inspection.expect_optional_index("texture", frame.lights[i].texture, textures);
    }
    inspection.at({.kind = "sun"});
    inspect_sun(inspection, frame.sun);
    for (std::size_t i = 0; i < frame.light_volumes.size(); ++i) {
        inspection.at({.kind = "light volume", .index = i});
        inspect_volume(inspection, frame.light_volumes[i]);
    }
}

}  // namespace strata
