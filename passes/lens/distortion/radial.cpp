#include "passes/lens/distortion/radial.h"

#include <algorithm>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/lens/lens.shared.h"

namespace strata::lens {

double radial_scale(double k1, double width, double height) {
    // The corners reach farthest where k1 is positive, the middle of the longer sides where it is negative.
    const double shorter = std::min(width, height), r2 = k1 > 0 ? 1 : shorter * shorter / (width * width + height * height);
    return 1 / (1 + k1 * r2);
}

void distort(Graph& graph, FrameImages& frame, const LensParams& params) {
    Image distorted = graph.create("color", graph.shape(frame.color));
    const double scale = radial_scale(double(params.k1), frame.extent.width, frame.extent.height);
    graph.compute("lens/distortion/radial.comp")
        .samples("color", frame.color)
        .stores("distorted", distorted)
        .push(RadialPush{.k1 = params.k1, .scale = float(scale)})
        .over({frame.extent.width, frame.extent.height, frame.samples});
    frame.color = distorted;
}

}  // namespace strata::lens
