#include "captures/scenarios.h"

#include <array>
#include <string>
#include <vector>

#include "capture_format/nearest_name.h"
#include "captures/scenarios/builders.h"

namespace strata {
namespace {

constexpr auto scenario_table = std::to_array<Scenario>({
    // First those in which an order of whole objects is wrong.
    {"smoke_grenade", "Is a character seen inside thick smoke, and a signal's smoke that the wind drives through it?", 320, 180,
     scenario::smoke_grenade},
    {"explosion", "Is fire dimmed by the smoke before it, and by none of the smoke behind it?", 96, 54, scenario::explosion},
    {"interpenetrating_panes", "Does sorting by object fail where panes cross each other?", 96, 54,
     scenario::interpenetrating_panes},
    {"facade_at_150m", "Are panes 0.3 m apart told apart at 150 m, and from the smoke and the cars behind them?", 96, 54,
     scenario::facade_at_150m},
    {"tail_light", "Is clear plastic 3 mm before red plastic clear over red, and not red over clear?", 96, 54,
     scenario::tail_light},
    {"three_cards", "What leaks through three almost opaque cards at almost one depth?", 160, 90, scenario::three_cards},
    {"glass_and_smoke", "Do colored glass, smoke and a lit room agree about what lies between them?", 160, 90,
     scenario::glass_and_smoke},
    {"empty", "What does an empty frame cost?", 64, 36, scenario::empty},
    {"opaque_only", "Does a stage that is not needed stay out of the way?", 96, 54, scenario::opaque_only},
    {"one_pane", "Is one layer over a background exact?", 64, 36, scenario::one_pane},
    {"three_panes", "Does the order of submission show where three colors overlap?", 64, 36, scenario::three_panes},
    {"sixty_layers", "What happens beyond the number of layers a technique keeps?", 64, 36, scenario::sixty_layers},
    {"two_hundred_layers", "Do two hundred layers of one percent survive thresholds and half floats?", 64, 36,
     scenario::two_hundred_layers},
    {"pane_at_the_lens", "Does a layer just behind the near plane ruin a technique's depth range?", 64, 36,
     scenario::pane_at_the_lens},
    {"red_and_green_glass", "Is transmittance a color: what is seen through red glass and green glass?", 64, 36,
     scenario::red_and_green_glass},
    {"additive_sparks", "Do sparks without coverage stay bright, and dim behind a pane?", 96, 54, scenario::additive_sparks},
    {"coincident_panes", "Which of three panes at exactly one depth is in front?", 64, 36, scenario::coincident_panes},
    {"nan_particles", "Does a particle with NaN values leave its neighbors intact?", 64, 36, scenario::nan_particles},
    {"one_sphere", "Does a sphere in uniform light reflect its albedo and no more?", 64, 36, scenario::one_sphere},
    {"sun_and_boxes", "Where do the cascades of the sun's shadow meet, and does it show?", 160, 90, scenario::sun_and_boxes},
    {"spot_and_box", "Is the shadow of one box in one spot light where it should be?", 96, 54, scenario::spot_and_box},
    {"soft_shadows", "Are the penumbrae of a spot, a globe and a hazy sun as wide as their sources make them?", 64, 36,
     scenario::soft_shadows},
    {"materials", "Do the lighting models differ where they should, roughness by roughness?", 160, 90, scenario::materials},
    {"lighting_models", "Does every lighting model shine, from in front and from behind, as its formulas say?", 160, 90,
     scenario::lighting_models},
    {"lights_room", "Does a tile see every one of 32 lights that reaches it, and no other?", 160, 90, scenario::lights_room},
    {"blocker_rooms", "Does the light of a room leave it by the door alone?", 96, 54, scenario::blocker_rooms},
    {"light_types", "Does each type of light have its brightness, size and softness on every surface?", 96, 54,
     scenario::light_types},
    {"city_of_boxes", "Of 400 boxes, how many are drawn when most are out of sight?", 160, 90, scenario::city_of_boxes},
    {"foggy_panes", "Is fog between the layers, rather than over the picture?", 96, 54, scenario::foggy_panes},
    {"thin_layers", "Does a ramp of two hundred thin layers differ from its mirror image, and by exactly how much?", 64, 36,
     scenario::thin_layers},
    {"particle_storm", "What does a storm of ash cost that lies eight layers deep over every extent?", 96, 54,
     scenario::particle_storm},
    {"interface_layers", "Are in-world interfaces blended by layer in front of the world, wherever their surfaces are?", 96, 54,
     scenario::interface_layers},
    {"agents_hq", "Of 200 lights of every type behind walls with doors and windows, what does each tile have to shade?", 96, 54,
     scenario::agents_hq},
    {"hall_of_lights_1", "What does culling of lights cost where one light reaches everything?", 96, 54,
     scenario::hall_of_lights_1},
    {"hall_of_lights_64", "What do 64 lights cost, as many as a tile keeps?", 96, 54, scenario::hall_of_lights_64},
    {"hall_of_lights_65", "What does one light more than a tile keeps cost?", 96, 54, scenario::hall_of_lights_65},
    {"hall_of_lights_512", "Does time grow with the lights, or with those that reach a pixel?", 96, 54,
     scenario::hall_of_lights_512},
    {"hall_of_lights_4096", "Does culling itself stay cheap at 4096 lights?", 96, 54, scenario::hall_of_lights_4096},
    {"pair_overflow", "Do 272 pairs of lights and blockers give the right picture where a tile keeps 256?", 96, 54,
     scenario::pair_overflow},
    {"cornell_box", "Is white paint as red and as green beside the colored walls of a measured room as it should be?", 64, 64,
     scenario::cornell_box},
    {"two_rooms", "How much of a room's bounced light passes a thin wall with a closed door, and how much an open one?", 80, 45,
     scenario::two_rooms},
    {"courtyard", "Does sunlight that bounces into an arcade stay steady while the cascades follow a walking eye?", 80, 45,
     scenario::courtyard},
    {"fence_and_foliage", "Do a fence and leaves keep their area and their edges from 2 m to 60 m?", 80, 45,
     scenario::fence_and_foliage},
    {"sixteen_normals", "Which normals does a G-buffer store badly?", 64, 36, scenario::sixteen_normals},
    {"far_wall", "Does stored depth make stripes on planes from 1 m to 2 km?", 64, 36, scenario::far_wall},
    {"crossing_planes", "Is the line antialiased along which sheets intersect, where no triangle ends?", 96, 54,
     scenario::crossing_planes},
    {"corners", "How much ambient light reaches a corner, the foot of a pillar and the floor under a ball?", 64, 36,
     scenario::corners},
    {"tilted_ground", "What do bounds of a shadow map's texels decide on flat ground that is tilted to the sun?", 96, 54,
     scenario::tilted_ground},
    {"thirty_boxes", "How many pixels do bounds of a shadow map's texels leave to its filter around boxes in the sun?", 96, 54,
     scenario::thirty_boxes},
    {"leaves", "What do bounds of a shadow map's texels cost under trees, where they decide little?", 96, 54, scenario::leaves},
    {"hall_with_shafts", "Do shafts of sunlight in a dusty hall begin and end at the windows and the hole in the roof?", 96, 54,
     scenario::hall_with_shafts},
    {"zone_at_dusk",
     "Do low sun, wet concrete and rain agree: where it is lit, where it is wet, and where a roof keeps both off?", 96, 54,
     scenario::zone_at_dusk},
    {"night_market", "What does a frame of a game cost that needs every stage, and what does each technique get wrong there?", 96,
     54, scenario::night_market},
    {"beams", "Do beams of sunlight in foggy air begin and end where a roof with holes lets them?", 64, 36, scenario::beams},
    {"roof_in_rain", "Does everything get wet that rain reaches, and nothing under a roof?", 64, 36, scenario::roof_in_rain},
    {"lamp_at_night", "Does a lens blur, bend, expose and glow as it should, and keep what is in focus sharp?", 64, 36,
     scenario::lamp_at_night},
    // The scenes of two public demonstrations, at the extents that times are published for.
    {"spheres_125", "What do five spheres in a row cost, of which only front faces are seen?", 640, 360, scenario::spheres_125},
    {"spheres_1024", "What do a thousand small spheres cost where several lie over every pixel?", 480, 360,
     scenario::spheres_1024},
    {"opaque_spheres_1024", "What do a thousand small opaque spheres cost, of which each hides what is behind it?", 480, 360,
     scenario::opaque_spheres_1024},
});

}  // namespace

std::span<const Scenario> scenarios() { return scenario_table; }

Result<const Scenario*> find_scenario(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Scenario& scenario : scenario_table) {
        if (scenario.name == name) return &scenario;
        names.push_back(scenario.name);
    }
    return fail(Fault::usage, "scenario.unknown", "there is no scenario {scenario}{suggestion}", name, did_you_mean(name, names));
}

}  // namespace strata
