#include "passes/transparency/depth_peeling/model.h"

#include <algorithm>

#include "capture_format/frame/frame.h"
#include "capture_format/frame_features.h"
#include "passes/settings.h"
#include "passes/stage_input.h"
#include "passes/transparency/depth_peeling/depth_peeling_params.h"
#include "passes/transparency/distortion/model.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {
namespace {

/// Whether two depths that differ may be one to a float: then a layer is lost or not.
bool is_doubtful(std::span<const Fragment> fragments) {
    const std::vector<Fragment> sorted = nearest_first(fragments);
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        const double gap = sorted[i].depth - sorted[i - 1].depth;
        if (gap > 0 && gap < sorted[i].depth * 0x1p-22) return true;
    }
    return false;
}

}  // namespace

glm::dvec3 peeled_blend(std::span<const Fragment> fragments, glm::dvec3 behind, std::uint32_t passes, double near) {
    glm::dvec3 color(0), through(1);
    double last = 0;
    std::uint32_t peeled = 0;
    for (const Fragment& fragment : nearest_first(fragments)) {
        const double depth = std::max(fragment.depth, near);
        if (depth <= last || peeled == passes) continue;
        color += through * (fragment.color + fragment.emission);
        through *= fragment.transmittance;
        last = depth;
        ++peeled;
    }
    return color + through * behind;
}

ImageSet depth_peeling_model(const StageInput& input, const Settings& settings) {
    const std::uint32_t passes = settings.as<DepthPeelingParams>().passes;
    const bool has_interfaces = frame_features(input.frame).has(Feature::interface_layers);
    const double near = has_interfaces ? 0 : double(input.frame.view.near);  // as near as it gets
    const PlacedBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3) -> BlendedSample {
        return {peeled_blend(fragments, behind, passes, near), is_doubtful(fragments)};
    };
    return {{"color", blended(background(input), input, blend)}};
}

}  // namespace strata::transparency
