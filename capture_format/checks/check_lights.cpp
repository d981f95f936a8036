// The lights of check_frame(). Directions must be unit where a formula relies on it: an omni light's may be anything finite.
#include "capture_format/inspection.h"

namespace strata {
namespace {

constexpr double half_pi = 1.57079633;      // rounded up: a float's pi / 2 passes
constexpr double widest_projection = 1.55;  // 88.8 degrees: the tangent of a projected spot's half angle stays below 50
constexpr std::size_t most_clip_planes = 6, most_blockers = 32, most_portals = 32;
constexpr std::uint32_t most_cascades = 8, most_cells = 256, most_iterations = 1024;

void inspect_shadow(Inspection& inspection, const ShadowUse& shadow) {
    inspection.expect(within(shadow.map_size, 1, largest_extent), "a shadow map has 1 to {} texels each way, not {}",
                      largest_extent, shadow.map_size);
    inspection.expect(finite(shadow.bias), "the shadow's bias is not finite");
}

bool is_spot(const Light& light) { return light.type == LightType::round_spot || light.type == LightType::square_spot; }

/// Spots that look through a projection: a square one, one with a picture, one with a shadow map.
bool projects(const Light& light) {
    return is_spot(light) && (light.type == LightType::square_spot || light.texture != no_index || light.shadow.casts);
}

void inspect_directions(Inspection& inspection, const Light& light) {
    const bool flat = light.type == LightType::disc || light.type == LightType::rectangle;
    if (is_spot(light) || flat || light.type == LightType::directional) {
        inspection.expect(unit(light.direction), "its direction must be unit");
    }
    if (light.type == LightType::tube) inspection.expect(unit(light.axis_u), "a tube's axis_u must be unit");
    if (projects(light) || light.type == LightType::rectangle) {
        inspection.expect(unit(light.axis_u) && perpendicular(light.axis_u, light.direction),
                          "its axis_u must be unit and perpendicular to its direction");
    }
}

void inspect_angles(Inspection& inspection, const Light& light) {
    inspection.expect(finite(light.inner_angle) && finite(light.outer_angle), "its angles are not finite");
    if (!is_spot(light)) return;
    const double widest = projects(light) ? widest_projection : half_pi;
    inspection.expect(light.outer_angle > 0 && light.outer_angle <= widest,
                      "its outer half angle must be above 0 and up to {}, not {}", widest, light.outer_angle);
    const double inner_limit = light.type == LightType::round_spot ? light.outer_angle : widest;
    inspection.expect(within(light.inner_angle, 0, inner_limit), "its inner half angle must be 0 to {}, not {}", inner_limit,
                      light.inner_angle);
}

void inspect_indices(Inspection& inspection, const Frame& frame, const Light& light) {
    inspection.expect(light.clip_planes.size() <= most_clip_planes, "a light has up to {} clip planes, not {}", most_clip_planes,
                      light.clip_planes.size());
    for (const ClipPlane& plane : light.clip_planes) {
        inspection.expect(unit(plane.normal) && finite(plane.distance), "a clip plane needs a unit normal and a finite distance");
    }
    inspection.expect(light.blockers.size() <= most_blockers, "a light has up to {} blockers, not {}", most_blockers,
                      light.blockers.size());
    for (const std::uint32_t blocker : light.blockers) {
        inspection.expect(blocker < frame.blockers.size(), "it lists blocker {} of {}", blocker, frame.blockers.size());
    }
    inspection.expect(light.portals.size() <= most_portals, "a light has up to {} portals, not {}", most_portals,
                      light.portals.size());
    for (const std::uint32_t portal : light.portals) {
        inspection.expect(portal < frame.portals.size(), "it lists portal {} of {}", portal, frame.portals.size());
    }
}

void inspect_light(Inspection& inspection, const Frame& frame, const Light& light) {
    inspection.expect(light.name.size() <= longest_text, "names may have {} bytes", longest_text);
    inspection.expect(known(light.type, LightType::directional), "there is no light type {}",
                      static_cast<std::uint32_t>(light.type));
    inspection.expect(finite(light.position), "its position is not finite");
    inspection.expect(finite(light.direction) && finite(light.axis_u), "its direction or axis_u is not finite");
    inspection.expect(finite(light.intensity), "its intensity is not finite");
    inspection.expect(positive_or_zero(light.range), "its range must be 0 m or above, not {}", light.range);
    inspection.expect(positive_or_zero(light.source_radius), "its source radius must be 0 m or above, not {}",
                      light.source_radius);
    inspection.expect(positive_or_zero(light.half_extent.x) && positive_or_zero(light.half_extent.y),
                      "its half extent must be 0 m or above");
    inspect_directions(inspection, light);
    inspect_angles(inspection, light);
    inspect_shadow(inspection, light.shadow);
    inspect_indices(inspection, frame, light);
}

/// Blockers and portals are the same rectangle.
template <typename Rectangle>
void inspect_rectangle(Inspection& inspection, const Rectangle& rectangle) {
    inspection.expect(finite(rectangle.center), "its center is not finite");
    inspection.expect(unit(rectangle.u) && unit(rectangle.v) && perpendicular(rectangle.u, rectangle.v),
                      "its u and v must be unit and perpendicular");
    inspection.expect(positive_or_zero(rectangle.half_u) && positive_or_zero(rectangle.half_v),
                      "its half sizes must be 0 m or above");
}

void inspect_sun(Inspection& inspection, const Sun& sun) {
    inspection.expect(unit(sun.direction), "its direction must be unit");
    inspection.expect(finite(sun.irradiance), "its irradiance is not finite");
    inspection.expect(within(sun.angular_radius, 0, half_pi), "its angular radius must be 0 to pi / 2, not {}",
                      sun.angular_radius);
    inspection.expect(within(sun.cascades, 1, most_cascades), "it has 1 to {} cascades, not {}", most_cascades, sun.cascades);
    inspection.expect(positive(sun.shadow_distance), "its shadow distance must be above 0 m, not {}", sun.shadow_distance);
    inspect_shadow(inspection, sun.shadow);
}

void inspect_volume(Inspection& inspection, const LightVolume& volume) {
    inspection.expect(known(volume.kind, VolumeKind::fixed_local), "there is no kind {}",
                      static_cast<std::uint32_t>(volume.kind));
    inspection.expect(known(volume.occlusion, VolumeOcclusion::axial), "there is no occlusion {}",
                      static_cast<std::uint32_t>(volume.occlusion));
    inspection.expect(finite(volume.center), "its center is not finite");
    for (int i = 0; i < 3; ++i) {
        inspection.expect(positive(volume.half_extent[i]), "its half extent must be above 0 m, not {}", volume.half_extent[i]);
        inspection.expect(within(volume.cells[i], 1, most_cells), "it has 1 to {} cells each way, not {}", most_cells,
                          volume.cells[i]);
    }
    inspection.expect(within(volume.cascades, 1, most_cascades), "it has 1 to {} cascades, not {}", most_cascades,
                      volume.cascades);
    inspection.expect(volume.iterations <= most_iterations, "it has up to {} iterations, not {}", most_iterations,
                      volume.iterations);
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
        inspection.expect(frame.portals[i].blocker < frame.blockers.size(), "it is a hole in blocker {} of {}",
                          frame.portals[i].blocker, frame.blockers.size());
    }
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        inspection.at({"light", i, frame.lights[i].name});
        inspect_light(inspection, frame, frame.lights[i]);
        inspection.expect(optional_index(frame.lights[i].texture, textures), "it uses texture {} of {}", frame.lights[i].texture,
                          textures);
    }
    inspection.at({.kind = "sun"});
    inspect_sun(inspection, frame.sun);
    for (std::size_t i = 0; i < frame.light_volumes.size(); ++i) {
        inspection.at({.kind = "light volume", .index = i});
        inspect_volume(inspection, frame.light_volumes[i]);
    }
}

}  // namespace strata
