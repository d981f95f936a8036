// The table of stages. A stage that is unwanted is left out with its techniques' own acts; what another stage's technique does
// at this point of the frame still happens.
#include "passes/stages.h"

#include <cassert>

#include "passes/combine/judge.h"
#include "passes/combine/truth.h"
#include "passes/culling/judge.h"
#include "passes/culling/truth.h"
#include "passes/edges/judge.h"
#include "passes/edges/truth.h"
#include "passes/gbuffer/judge.h"
#include "passes/gbuffer/truth.h"
#include "passes/lighting/judge.h"
#include "passes/lighting/truth.h"
#include "passes/shadows/judge.h"
#include "passes/shadows/truth.h"
#include "passes/transparency/judge.h"
#include "passes/transparency/truth.h"

namespace strata {
namespace {

using Reason = std::optional<std::string>;

Reason always_wanted(const Features&) { return std::nullopt; }

Reason no_opaque_draws(const Features& features) {
    if (features.has(Feature::opaque) || features.has(Feature::masked)) return std::nullopt;
    return "the frame has no opaque draws";
}

Reason no_shadows(const Features& features) {
    if (features.has(Feature::shadows)) return std::nullopt;
    return "no light of the frame casts shadows";
}

Reason no_transparency(const Features& features) {
    if (features.has(Feature::transparent) || features.has(Feature::additive) || features.has(Feature::particles))
        return std::nullopt;
    return "the frame has no transparent draws or particles";
}

Reason nothing_to_extinguish(const Features& features) {
    if (auto reason = no_transparency(features)) return reason;
    return no_opaque_draws(features);
}

Reason one_sample(const Features& features) {
    if (features.has(Feature::multisampled)) return std::nullopt;
    return "the frame has one sample per pixel";
}

Reason no_rain(const Features& features) {
    if (features.has(Feature::rain)) return std::nullopt;
    return "the frame has no rain";
}

Reason no_ambient_light(const Features& features) {
    if (features.has(Feature::hemisphere) || features.has(Feature::light_volumes)) return std::nullopt;
    return "the frame has no ambient light to occlude";
}

Reason no_light_volumes(const Features& features) {
    if (features.has(Feature::light_volumes)) return std::nullopt;
    return "the frame has no light volumes";
}

Reason no_lights(const Features& features) {
    if (features.has(Feature::sun) || features.has(Feature::local_lights)) return std::nullopt;
    return "the frame has no lights";
}

Reason no_sun_shafts(const Features& features) {
    if (!features.has(Feature::sun)) return "the frame has no sun";
    if (!features.has(Feature::sun_shafts)) return "the sun throws no shafts";
    return std::nullopt;
}

Reason plain_lens(const Features& features) {
    for (const Feature feature : {Feature::bloom, Feature::auto_exposure, Feature::depth_of_field, Feature::lens_distortion})
        if (features.has(feature)) return std::nullopt;
    return "the lens neither blooms, adapts, focuses nor distorts";
}

Reason clean_film(const Features& features) {
    if (features.has(Feature::grain)) return std::nullopt;
    return "the film has no grain and does not fade";
}

std::vector<StageInfo> made_table() {
    return {
        {.stage = Stage::culling,
         .name = "culling",
         .purpose = "which opaque draws are drawn",
         .unwanted = no_opaque_draws,
         .outputs = {"visible"},
         .truth = culling_truth,
         .judge = culling_judge,
         .scenarios = {"opaque_only", "city_of_boxes", "sun_and_boxes", "materials"}},
        {.stage = Stage::shadows,
         .name = "shadows",
         .purpose = "how much of each light reaches a surface",
         .unwanted = no_shadows,
         .outputs = {"visibility", "shadow_maps"},
         .truth = shadows_truth,
         .judge = shadows_judge,
         .scenarios = {"sun_and_boxes", "spot_and_box"}},
        {.stage = Stage::extinction,
         .name = "extinction",
         .purpose = "from which depth on nothing shows through what is transparent",
         .unwanted = nothing_to_extinguish,
         .outputs = {},
         .scenarios = {}},
        {.stage = Stage::gbuffer,
         .name = "gbuffer",
         .purpose = "the nearest opaque surface of every sample",
         .unwanted = always_wanted,
         .outputs = {"surface_normal", "surface_color", "surface_material", "emission", "depth_layers", "depth", "gbuffer0",
                     "gbuffer1", "gbuffer2"},
         .truth = gbuffer_truth,
         .judge = gbuffer_judge,
         .scenarios = {"one_sphere", "materials", "lighting_models", "opaque_only", "city_of_boxes", "sun_and_boxes"}},
        {.stage = Stage::edges,
         .name = "edges",
         .purpose = "pixels whose samples are shaded one by one",
         .unwanted = one_sample,
         .outputs = {"edges"},
         .truth = edges_truth,
         .judge = edges_judge,
         .scenarios = {"one_sphere", "sun_and_boxes", "city_of_boxes"}},
        {.stage = Stage::rain,
         .name = "rain",
         .purpose = "what water does to surfaces",
         .unwanted = no_rain,
         .outputs = {"gbuffer0", "gbuffer1"},
         .scenarios = {}},
        {.stage = Stage::occlusion,
         .name = "occlusion",
         .purpose = "how much of the ambient light reaches a surface",
         .unwanted = no_ambient_light,
         .outputs = {"occlusion"},
         .scenarios = {}},
        {.stage = Stage::indirect,
         .name = "indirect",
         .purpose = "light that comes by way of other surfaces",
         .unwanted = no_light_volumes,
         .outputs = {"indirect"},
         .scenarios = {}},
        {.stage = Stage::lighting,
         .name = "lighting",
         .purpose = "what surfaces reflect of the lights",
         .unwanted = no_lights,
         .outputs = {"light"},
         .truth = lighting_truth,
         .judge = lighting_judge,
         .scenarios = {"one_sphere", "materials", "lighting_models", "light_types", "lights_room", "blocker_rooms",
                       "spot_and_box", "sun_and_boxes"}},
        {.stage = Stage::sun_shafts,
         .name = "sun_shafts",
         .purpose = "sunlight scattered by the air",
         .unwanted = no_sun_shafts,
         .outputs = {},
         .scenarios = {}},
        {.stage = Stage::combine,
         .name = "combine",
         .purpose = "light, emission and fog become radiance, and radiance a picture",
         .unwanted = always_wanted,
         .outputs = {"color", "display"},
         .truth = combine_truth,
         .judge = combine_judge,
         .scenarios = {"one_sphere", "materials", "lighting_models", "opaque_only", "sun_and_boxes", "foggy_panes"}},
        {.stage = Stage::transparency,
         .name = "transparency",
         .purpose = "everything that lets light through, blended over the opaque frame",
         .unwanted = no_transparency,
         .outputs = {"color"},
         .truth = transparency_truth,
         .judge = transparency_judge,
         .scenarios =
             {"one_pane",         "three_panes",         "interpenetrating_panes", "sixty_layers",     "two_hundred_layers",
              "pane_at_the_lens", "red_and_green_glass", "additive_sparks",        "coincident_panes", "nan_particles",
              "foggy_panes",      "three_cards",         "facade_at_150m",         "tail_light",       "explosion",
              "thin_layers",      "particle_storm",      "interface_layers",       "smoke_grenade",    "glass_and_smoke"}},
        {.stage = Stage::lens,
         .name = "lens",
         .purpose = "what the camera's optics do to the picture",
         .unwanted = plain_lens,
         .outputs = {"color"},
         .scenarios = {}},
        {.stage = Stage::film,
         .name = "film",
         .purpose = "grain and fading of the recorded picture",
         .unwanted = clean_film,
         .outputs = {"display"},
         .scenarios = {}},
    };
}

}  // namespace

std::span<const StageInfo> stages() {
    static const std::vector<StageInfo> table = made_table();
    return table;
}

const StageInfo& info(Stage stage) {
    const StageInfo& found = stages()[static_cast<std::size_t>(stage)];
    assert(found.stage == stage && "the table of stages is in the enumerators' order");
    return found;
}

std::optional<Stage> find_stage(std::string_view name) {
    for (const StageInfo& stage : stages())
        if (stage.name == name) return stage.stage;
    return std::nullopt;
}

}  // namespace strata
