#include "passes/lens/camera/views.h"

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/lens/bloom/glow.h"
#include "passes/lens/depth_of_field/focus.h"
#include "passes/lens/exposure/adaptation.h"
#include "passes/settings.h"

namespace strata::lens {
namespace {

/// A view or a table made from the settings' struct.
template <Image (*make)(Graph&, const FrameImages&, const LensParams&)>
Image made(Graph& graph, FrameImages& frame, const Settings& settings) {
    return make(graph, frame, settings.as<LensParams>());
}

}  // namespace

std::vector<DebugView> camera_views() {
    return {{.name = "circle of confusion",
             .help = "radius of the blur of each pixel's first sample before distortion; below 0: nearer than the plane in focus",
             .unit = "pixels",
             .low = -16,
             .high = 16,
             .declare = made<show_blur>,
             .if_zero = "every pixel is in focus"},
            {.name = "taps",
             .help = "taps of depth of field that give light to each pixel's first sample, before distortion; few taps: noise",
             .unit = "taps",
             .high = 64,
             .declare = made<show_taps>,
             .channels = {"before the surface", "on the surface", "behind the surface"},
             .if_zero = "no pixel gathers light of others"},
            {.name = "bloom",
             .help = "the glow alone: radiance before exposure that bloom adds to every sample of a pixel",
             .unit = "W/(m^2 sr)",
             .declare = made<show_glow>,
             .channels = {"red", "green", "blue"},
             .if_zero = "nothing glows"}};
}

std::vector<DebugTable> camera_tables() {
    return {{.name = "exposure",
             .help = "mean luminance, the exposure it asks for, this frame's and the previous one's; luminance 0: no adaptation; "
                     "previous 0: there was none",
             .columns = {{"luminance", "exposed radiance"},
                         {"target", "x recorded exposure"},
                         {"exposure", "x recorded exposure"},
                         {"previous", "x recorded exposure"}},
             .declare = made<list_exposure>}};
}

}  // namespace strata::lens
