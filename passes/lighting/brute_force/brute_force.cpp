// Every light on every sample: what other lighting techniques are measured against.
#include "passes/choice_names.h"
#include "passes/edges/routing/ratios.h"
#include "passes/edges/routing/shade_samples.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/lighting/brute_force/brute_force.shared.h"
#include "passes/lighting/brute_force/brute_force_params.h"
#include "passes/lighting/every_light.h"
#include "passes/lighting/material_table.h"
#include "passes/scene/scene_facts.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::lighting {

ImageSet brute_force_model(const StageInput&, const Settings&);

namespace {

constexpr auto material_sources = choice_names({{materials_recorded, "recorded"}, {materials_table, "table"}});
constexpr auto speculars = choice_names({{specular_colored, "colored"}, {specular_white, "white"}});

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return;
    const auto params = settings.as<BruteForceParams>();
    const Image table = params.materials == materials_table ? material_table(graph) : Image{};
    frame.light = graph.create("light", {.extent = frame.extent, .format = Format::rgba16f, .layers = frame.samples});
    edges::shade_samples(graph, frame, params.routing, {"light", frame.light}, [&] {
        return sample_gbuffer(graph.compute("lighting/brute_force/shade.comp"), frame)
            .samples("visibility", frame.visibility)
            .fixes("has_visibility", frame.visibility ? 1u : 0u)
            .fixes("features", frame.facts->light_features())
            .samples("material_table", table)
            .fixes("material_source", params.materials)
            .fixes("specular", params.specular);
    });
}

}  // namespace

Technique brute_force() {
    return {
        .stage = Stage::lighting,
        .name = "lighting/brute_force",
        .title = "Every light on every sample",
        .source = "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, GDC 2009 (shading per sample at edges)",
        .summary =
            "Loops over all lights for each sample; exact up to half floats, and its time grows with the lights that miss.",
        .params = {param<&BruteForceParams::routing>(edges::routing_row),
                   param<&BruteForceParams::materials>(
                       {.name = "materials",
                        .fallback = materials_recorded,
                        .help = "reflectance of surfaces: as recorded, or an 8-bit table of four materials (X-Ray)",
                        .choices = material_sources}),
                   param<&BruteForceParams::specular>(
                       {.name = "specular",
                        .fallback = specular_colored,
                        .help = "color of a light in highlights: kept, or white as in a light buffer of four channels",
                        .choices = speculars})},
        .variants = {"materials=table", "specular=white", "materials=table specular=white"},
        .counters = {counter<&BruteForceCounters::evaluations>({.name = "evaluations", .help = "lights times samples shaded"}),
                     counter<&BruteForceCounters::samples_shaded>(
                         {.name = "samples_shaded", .help = "samples with a lit surface, plain pixels counted once"}),
                     counter<&BruteForceCounters::unfinished>(unfinished_row)},
        .counter_bytes = sizeof(BruteForceCounters),
        .abilities = {.is_time_unit = true},
        .claims = {.ratios = edges::routing_ratios()},
        .declare = declare,
        .model = brute_force_model,
        .tolerance = shaded_light_tolerance};
}

}  // namespace strata::lighting
