#include "passes/culling/hiz_two_phase/views.h"

#include "passes/culling/hiz_two_phase/hiz_two_phase.shared.h"
#include "passes/culling/hiz_two_phase/hiz_two_phase_params.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/settings.h"

namespace strata::culling {
namespace {

template <std::uint32_t shown>
Image view(Graph& graph, FrameImages& frame, const Settings& settings) {
    Image picture = graph.create("hiz view", Shape{.extent = frame.extent, .format = Format::rgba32f});
    if (frame.all_opaque.count == 0) {
        graph.clear(picture, {});
        return picture;
    }
    graph.compute("culling/hiz_two_phase/view.comp")
        .loads("Pyramid", graph.find_buffer(pyramid_name))
        .loads("HizDraws", graph.find_buffer(draws_name))
        .stores("picture", picture)
        .fixes("shown", shown)
        .push(HizView{.count = frame.all_opaque.count, .level = settings.as<HizParams>().level})
        .over(frame.extent);
    return picture;
}

/// Of outlines, and of those that cross or lie upon each other.
std::vector<ViewColor> border_colors() {
    return {{{1, 0, 0}, "hidden"},
            {{0, 1, 0}, "visible and drawn in phase 1"},
            {{0, 0, 1}, "visible and not drawn in phase 1"},
            {{1, 1, 0}, "red and green on one pixel"},
            {{1, 0, 1}, "red and blue on one pixel"},
            {{0, 1, 1}, "green and blue on one pixel"},
            {{1, 1, 1}, "all three on one pixel"},
            {{0, 0, 0}, "no outline"}};
}

}  // namespace

std::vector<DebugView> hiz_two_phase_views() {
    return {{.name = "pyramid",
             .help = "farthest depth of occluders in each texel of pyramid level `level`; 0: part of the texel has no occluder",
             .unit = "m",
             .low = 0,
             .high = 50,
             .declare = view<hiz_view_pyramid>},
            {.name = "hidden",
             .help = "number of culled draws whose screen bounds cover the pixel",
             .unit = "draws",
             .low = 0,
             .high = 16,
             .declare = view<hiz_view_hidden>},
            {.name = "bounds",
             .help = "outlines of the draws' screen bounds; red: hidden; green: visible and drawn in phase 1; blue: visible and "
                     "not drawn in phase 1",
             .unit = "",
             .low = 0,
             .high = 1,
             .declare = view<hiz_view_bounds>,
             .colors = border_colors()}};
}

}  // namespace strata::culling
