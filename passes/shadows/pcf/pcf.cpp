// Percentage-closer filtered shadow maps: casters are drawn into one layer per map before the G-buffer, and every sample of
// the G-buffer is looked up in them after it.
#include <algorithm>

#include "passes/shadows/pcf/pcf.shared.h"
#include "passes/shadows/shadow_views.h"
#include "passes/technique.h"
#include "passes/texture_uses.h"

namespace strata::shadows {

ImageSet pcf_model(const StageInput&, const Settings&);

namespace {

constexpr std::string_view kernels[] = {"2x2", "4x4", "8x8"};

// One layer per map, each as large as the largest; a smaller map lies in its layer's upper left corner.
void draw_maps(Graph& graph, FrameImages& frame, const Settings&) {
    const std::vector<ShadowView> views = shadow_views(*frame.recorded);
    if (views.empty()) return;
    std::uint32_t largest = 0;
    for (const ShadowView& view : views) largest = std::max(largest, view.size);
    frame.shadow_maps =
        graph.create("shadow_maps",
                     {.extent = {largest, largest}, .format = Format::d32f, .layers = static_cast<std::uint32_t>(views.size())});
    graph.clear(frame.shadow_maps, {});
    for (std::uint32_t slot = 0; slot < views.size(); ++slot) {
        DrawPass cast = graph.draw("shadows/pcf/cast", frame.casters);
        fix_textures(cast, frame, Surfaces::opaque)
            .writes_depth(frame.shadow_maps, {.layer = slot})
            .within({views[slot].size, views[slot].size})
            .push(PcfSlot{slot});
    }
}

void filter_maps(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.shadow_maps) return;
    const auto shadowed = static_cast<std::uint32_t>(shadowed_lights(shadow_views(*frame.recorded)).size());
    const auto params = settings.as<PcfParams>();
    frame.visibility =
        graph.create("visibility", {.extent = frame.extent, .format = Format::r16f, .layers = shadowed * frame.samples});
    graph.compute("shadows/pcf/filter.comp")
        .samples("shadow_maps", frame.shadow_maps)
        .samples("depth_layers", frame.depth_layers)
        .samples("gbuffer0", frame.gbuffer0)
        .samples("gbuffer1", frame.gbuffer1)
        .samples("gbuffer2", frame.gbuffer2)
        .stores("visibility", frame.visibility)
        .fixes("taps", std::int32_t(2) << params.kernel)
        .fixes("gbuffer_layout", frame.gbuffer_layout)
        .fixes("has_gbuffer2", frame.gbuffer2 ? 1u : 0u)
        .push(params)
        .over({frame.extent.width, frame.extent.height, frame.samples});
}

}  // namespace

Technique pcf() {
    return {.stage = Stage::shadows,
            .name = "shadows/pcf",
            .title = "Percentage-closer filtering",
            .source =
                "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987; "
                "kernels of Lobanchikov and Gruen: Clear Sky, GDC 2009",
            .summary =
                "Averages depth comparisons over N x N texels; penumbrae have one width everywhere, and thin gaps between "
                "caster and receiver leak by the bias.",
            .params = {param<&PcfParams::kernel>({.name = "kernel",
                                                  .low = 0,
                                                  .high = 2,
                                                  .fallback = 1,
                                                  .help = "texels compared per lookup",
                                                  .choices = kernels}),
                       param<&PcfParams::slope_limit>({.name = "slope_limit",
                                                       .low = 0,
                                                       .high = 8,
                                                       .fallback = 4,
                                                       .help = "tangent of the steepest angle between normal and light that the "
                                                               "bias makes up for; 4 is 76 degrees"})},
            .counters = {counter<&PcfCounters::filtered>({.name = "filtered", .help = "samples times lights looked up"}),
                         counter<&PcfCounters::penumbra>({.name = "penumbra", .help = "of these, neither lit nor shadowed"})},
            .counter_bytes = sizeof(PcfCounters),
            .add = draw_maps,
            .also = {{.at = Stage::occlusion, .add = filter_maps}},
            .model = pcf_model,
            .tolerance = {.rmse = 3e-3,
                          .worst = 0.03,
                          .because = "fractions of a texel are cut to 1/256 after float arithmetic, which moves both by one step "
                                     "at most, and 16-bit floats round by 2^-11; comparisons that float may turn are undecided"}};
}

}  // namespace strata::shadows
