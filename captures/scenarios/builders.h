// One function per scenario; captures/scenarios.cpp holds the table.
#pragma once

#include <cstdint>

#include "capture_format/frame/frame.h"
#include "captures/scenarios.h"

namespace strata::scenario {

// smoke, glass, and what leaks through
Frame three_cards(std::uint32_t frame, const ScenarioOptions&);
Frame smoke_grenade(std::uint32_t frame, const ScenarioOptions&);
Frame smoke_core(std::uint32_t frame, const ScenarioOptions&);
Frame glass_and_smoke(std::uint32_t frame, const ScenarioOptions&);
Frame facade_at_150m(std::uint32_t frame, const ScenarioOptions&);
Frame tail_light(std::uint32_t frame, const ScenarioOptions&);
Frame explosion(std::uint32_t frame, const ScenarioOptions&);
Frame thick_explosion(std::uint32_t frame, const ScenarioOptions&);
Frame interface_layers(std::uint32_t frame, const ScenarioOptions&);
// layers.cpp
Frame one_pane(std::uint32_t frame, const ScenarioOptions&);
Frame three_panes(std::uint32_t frame, const ScenarioOptions&);
Frame interpenetrating_panes(std::uint32_t frame, const ScenarioOptions&);
Frame sixty_layers(std::uint32_t frame, const ScenarioOptions&);
Frame two_hundred_layers(std::uint32_t frame, const ScenarioOptions&);
Frame pane_at_the_lens(std::uint32_t frame, const ScenarioOptions&);
Frame red_and_green_glass(std::uint32_t frame, const ScenarioOptions&);
Frame coincident_panes(std::uint32_t frame, const ScenarioOptions&);
Frame stack_of_gels(std::uint32_t frame, const ScenarioOptions&);
Frame foggy_panes(std::uint32_t frame, const ScenarioOptions&);
Frame thin_layers(std::uint32_t frame, const ScenarioOptions&);
// particles.cpp
Frame additive_sparks(std::uint32_t frame, const ScenarioOptions&);
Frame nan_particles(std::uint32_t frame, const ScenarioOptions&);
Frame particle_storm(std::uint32_t frame, const ScenarioOptions&);
Frame ash_storm(std::uint32_t frame, const ScenarioOptions&);
// surfaces.cpp
Frame empty(std::uint32_t frame, const ScenarioOptions&);
Frame opaque_only(std::uint32_t frame, const ScenarioOptions&);
Frame one_sphere(std::uint32_t frame, const ScenarioOptions&);
Frame materials(std::uint32_t frame, const ScenarioOptions&);
Frame lighting_models(std::uint32_t frame, const ScenarioOptions&);
// illumination.cpp
Frame sun_and_boxes(std::uint32_t frame, const ScenarioOptions&);
Frame spot_and_box(std::uint32_t frame, const ScenarioOptions&);
Frame soft_shadows(std::uint32_t frame, const ScenarioOptions&);
Frame lights_room(std::uint32_t frame, const ScenarioOptions&);
Frame blocker_rooms(std::uint32_t frame, const ScenarioOptions&);
Frame city_of_boxes(std::uint32_t frame, const ScenarioOptions&);
// many lights
Frame agents_hq(std::uint32_t frame, const ScenarioOptions&);
Frame hall_of_lights_1(std::uint32_t frame, const ScenarioOptions&);
Frame hall_of_lights_64(std::uint32_t frame, const ScenarioOptions&);
Frame hall_of_lights_65(std::uint32_t frame, const ScenarioOptions&);
Frame hall_of_lights_512(std::uint32_t frame, const ScenarioOptions&);
Frame hall_of_lights_4096(std::uint32_t frame, const ScenarioOptions&);
Frame pair_overflow(std::uint32_t frame, const ScenarioOptions&);
// light_types.cpp
Frame light_types(std::uint32_t frame, const ScenarioOptions&);
// light_volumes.cpp
Frame cornell_box(std::uint32_t frame, const ScenarioOptions&);
Frame two_rooms(std::uint32_t frame, const ScenarioOptions&);
// courtyard.cpp
Frame courtyard(std::uint32_t frame, const ScenarioOptions&);
// fence_and_foliage.cpp
Frame fence_and_foliage(std::uint32_t frame, const ScenarioOptions&);
// gbuffer_cases.cpp
Frame sixteen_normals(std::uint32_t frame, const ScenarioOptions&);
Frame far_wall(std::uint32_t frame, const ScenarioOptions&);
// crossing_planes.cpp
Frame crossing_planes(std::uint32_t frame, const ScenarioOptions&);
// corners.cpp
Frame corners(std::uint32_t frame, const ScenarioOptions&);
// shadow_cases.cpp
Frame tilted_ground(std::uint32_t frame, const ScenarioOptions&);
Frame thirty_boxes(std::uint32_t frame, const ScenarioOptions&);
Frame leaves(std::uint32_t frame, const ScenarioOptions&);
// hall_with_shafts.cpp
Frame hall_with_shafts(std::uint32_t frame, const ScenarioOptions&);
// zone_at_dusk.cpp
Frame zone_at_dusk(std::uint32_t frame, const ScenarioOptions&);
// night_market/
Frame night_market(std::uint32_t frame, const ScenarioOptions&);
// beams.cpp
Frame beams(std::uint32_t frame, const ScenarioOptions&);
// roof_in_rain.cpp
Frame roof_in_rain(std::uint32_t frame, const ScenarioOptions&);
// lamp_at_night.cpp
Frame lamp_at_night(std::uint32_t frame, const ScenarioOptions&);
// spheres.cpp
Frame spheres_125(std::uint32_t frame, const ScenarioOptions&);
Frame spheres_1024(std::uint32_t frame, const ScenarioOptions&);
Frame opaque_spheres_1024(std::uint32_t frame, const ScenarioOptions&);

}  // namespace strata::scenario
