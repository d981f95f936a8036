// Edges are pixels in which a visible triangle covers some samples and not all.
#include "passes/choice_names.h"
#include "passes/edges/coverage/coverage_params.h"
#include "passes/edges/surface_tests.h"
#include "passes/edges/views/edge_views.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/coverage/fill_coverage.h"
#include "passes/gbuffer/layout.shared.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/scene_facts.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::edges {

ImageSet coverage_model(const StageInput&, const Settings&);

namespace {

constexpr auto companions = choice_names({{coverage_alone, "nothing"},
                                          {coverage_and_depth, "depth"},
                                          {coverage_and_material, "material"},
                                          {coverage_and_both, "depth_and_material"}});

std::uint32_t tests_of(std::uint32_t with_tests) {
    const bool has_depth = with_tests == coverage_and_depth || with_tests == coverage_and_both;
    const bool has_material = with_tests == coverage_and_material || with_tests == coverage_and_both;
    return (has_depth ? test_depth : 0) | (has_material ? test_material : 0);
}

/// 1 where a visible triangle covers a part of the pixel: a raster step over the visible draws and the finished depth. The
/// G-stage could write it on the way, into a target of its own that every technique would pay for.
Image partly_covered(Graph& graph, const FrameImages& frame) {
    Image partly = graph.create("partly covered", {.extent = frame.extent, .format = Format::r8ui});
    graph.clear(partly, {});
    if (frame.opaque.count == 0) return partly;
    const gbuffer::Coverage masks = gbuffer::declare_coverage_again(graph, frame);
    DrawStep draw = graph.draw("edges/coverage/partial", frame.opaque);
    gbuffer::add_coverage(draw, masks);
    fix_materials(draw, frame, Surfaces::opaque)
        .tests_depth(frame.depth)
        .at_equal_depth()
        .updates("partly", partly)
        .fixes("full_coverage", std::int32_t((1 << frame.samples) - 1));
    if (shows_no_backs(*frame.recorded, frame.facts->lists().opaque)) draw.culls(Cull::back);
    return partly;
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!has_samples(frame)) return;
    const auto params = settings.as<CoverageParams>();
    const Image partly = partly_covered(graph, frame);
    test_surfaces(mark_edges(graph, frame, "edges/coverage/mark.comp"), frame, tests_of(params.with_tests))
        .samples("partly", partly)
        .push(surface_limits(normal_angle_row.fallback, params.depth_step, params.color_step));
}

/// Where the masks of the G-buffer are not known to the bit.
std::vector<std::string> notes(const FrameImages& frame, const Settings&) {
    constexpr std::uint32_t masked = 1u << static_cast<std::uint32_t>(AlphaMode::mask);
    if (!has_samples(frame) || (frame.facts->material_uses(Surfaces::opaque).alpha_modes & masked) == 0) return {};
    if (frame.gbuffer_layout >> gbuffer::layout_masked_shift == gbuffer::masked_hardware)
        return {
            "edges/coverage: the device does not say which samples alpha to coverage takes; masked surfaces of an alpha between "
            "0 and 1 are all marked"};
    if ((frame.gbuffer_layout & gbuffer::layout_shaded_at_sample) != 0)
        return {
            "edges/coverage: alpha at samples is found from the pixel's center, to first order; attributes=sample may cover "
            "others"};
    return {};
}

}  // namespace

Technique coverage() {
    return {.stage = Stage::edges,
            .name = "edges/coverage",
            .title = "Triangles that cover part of a pixel",
            .source = "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, GDC 2009 (centroid trick)",
            .summary =
                "Draws opaque triangles once more and marks where coverage is partial: marks seams inside meshes, misses "
                "triangles that cross.",
            .params = {param<&CoverageParams::with_tests>({.name = "with_tests",
                                                           .high = coverage_and_both,
                                                           .fallback = coverage_alone,
                                                           .help = added_tests_help,
                                                           .choices = companions}),
                       param<&CoverageParams::depth_step>(depth_step_row), param<&CoverageParams::color_step>(color_step_row)},
            .variants = {"with_tests=depth", "with_tests=material", "with_tests=depth_and_material"},
            .counters = edge_counters(),
            .counter_bytes = sizeof(EdgeCounters),
            .views = edge_views(),
            .tables = edge_tables(),
            .declare = declare,
            .model = coverage_model,
            .tolerance = {.rmse = 0, .worst = 0, .because = "pixels whose coverage hangs on rounding are undecided"},
            .notes = notes};
}

}  // namespace strata::edges
