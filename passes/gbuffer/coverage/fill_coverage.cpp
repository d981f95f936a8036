#include "passes/gbuffer/coverage/fill_coverage.h"

#include <set>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/choice_names.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/coverage/mip_scales.h"
#include "passes/gbuffer/fill_params.h"
#include "passes/gbuffer/layout.shared.h"
#include "passes/graph/graph.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/scene_facts.h"

namespace strata::gbuffer {
namespace {

constexpr auto mask_modes = choice_names({{masked_clip, "clip"},
                                          {masked_per_sample, "per_sample"},
                                          {masked_per_sample_fine, "per_sample_fine"},
                                          {masked_a2c_1, "a2c_1"},
                                          {masked_a2c_2, "a2c_2"},
                                          {masked_a2c_or, "a2c_or"},
                                          {masked_full_step, "full_step"},
                                          {masked_unbiased, "unbiased"},
                                          {masked_mip_coverage, "mip_coverage"},
                                          {masked_sharpened, "sharpened"},
                                          {masked_hardware, "hardware"}});

bool has_masks(const FrameImages& frame) {
    const std::uint32_t mask = 1u << static_cast<std::uint32_t>(AlphaMode::mask);
    return (frame.facts->material_uses(Surfaces::opaque).alpha_modes & mask) != 0;
}

uint mode_that_matters(const FrameImages& frame, uint mode, ShadingRate rate) {
    if (!has_masks(frame)) return masked_clip;
    if (mode == masked_per_sample && (frame.samples == 1 || rate == ShadingRate::sample)) return masked_clip;
    const bool is_of_samples = mode == masked_per_sample_fine || mode == masked_sharpened || mode == masked_hardware;
    return is_of_samples && frame.samples == 1 ? masked_clip : mode;
}

std::set<std::uint32_t> masked_materials(const FrameImages& frame) {
    std::set<std::uint32_t> masked;
    for (const std::uint32_t draw : frame.facts->lists().opaque) {
        const std::uint32_t material = frame.recorded->draws[draw].material;
        if (frame.recorded->materials[material].alpha_mode == AlphaMode::mask) masked.insert(material);
    }
    return masked;
}

Image declare_scales(Graph& graph, const FrameImages& frame) {
    const auto materials = static_cast<std::uint32_t>(frame.recorded->materials.size());
    const Extent extent{mask_scale_columns * mask_scale_mips, (materials + mask_scale_columns - 1) / mask_scale_columns};
    Image scales = graph.create("mask scales", {.extent = extent, .format = Format::r32f});
    graph.clear(scales, {});
    for (const std::uint32_t material : masked_materials(frame)) {
        MaskScalesPush push{.material = material};
        const auto values = mip_scales(*frame.recorded, frame.recorded->materials[material]);
        for (std::size_t mip = 0; mip < values.size(); ++mip) push.scales[mip] = values[mip];
        graph.compute("gbuffer/coverage/scales.comp").updates("mask_scales", scales).push(push).over({mask_scale_mips});
    }
    return scales;
}

}  // namespace

Param masked_param() {
    return param<&FillParams::masked>({.name = "masked",
                                       .low = 0,
                                       .high = masked_hardware,
                                       .fallback = masked_clip,
                                       .help = "how alpha of masked surfaces becomes covered samples; clip: all samples if alpha "
                                               "at the pixel's center reaches the cutoff",
                                       .choices = mask_modes});
}

Coverage declare_coverage(Graph& graph, const FrameImages& frame, uint mode, ShadingRate rate) {
    Coverage coverage{.mode = mode_that_matters(frame, mode, rate), .samples = frame.samples, .rate = rate};
    if (coverage.mode == masked_mip_coverage) coverage.scales = declare_scales(graph, frame);
    return coverage;
}

Coverage declare_coverage_of_texels(Graph& graph, const FrameImages& frame, uint mode) {
    Coverage coverage{.mode = has_masks(frame) ? mode : masked_clip, .samples = 1};
    if (coverage.mode == masked_mip_coverage) coverage.scales = declare_scales(graph, frame);
    return coverage;
}

void add_coverage(DrawStep& builder, const Coverage& coverage) {
    const bool masks_in_shader = coverage.mode != masked_clip && coverage.mode != masked_hardware;
    builder.fixes("masked", coverage.mode)
        .fixes("mask_samples", masks_in_shader ? coverage.samples : 1u)
        .fixes("masks_at_sample", masks_in_shader && coverage.rate == ShadingRate::sample ? 1u : 0u)
        .samples("mask_scales", coverage.scales);
}

void draw_depth_by_alpha(Graph& graph, FrameImages& frame) {
    DrawStep draw = graph.draw("gbuffer/coverage/depth_by_alpha", frame.opaque);
    fix_materials(draw, frame, Surfaces::opaque);
    if (shows_no_backs(*frame.recorded, frame.facts->lists().opaque)) draw.culls(Cull::back);
    draw.covers_by_alpha().drops_other_colors().writes_depth(frame.depth);
}

Coverage declare_coverage_again(Graph& graph, const FrameImages& frame) {
    const uint mode = frame.gbuffer_layout >> layout_masked_shift;
    // Alpha at the sample against the cutoff is what the plain test does where attributes are the sample's.
    const bool at_sample = (frame.gbuffer_layout & layout_shaded_at_sample) != 0;
    return declare_coverage(graph, frame, at_sample && mode == masked_clip ? masked_per_sample : mode, ShadingRate::pixel);
}

}  // namespace strata::gbuffer
