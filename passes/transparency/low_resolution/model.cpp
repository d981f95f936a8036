#include "passes/transparency/low_resolution/model.h"

#include <utility>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame_features.h"
#include "capture_format/view.h"
#include "passes/stage_input.h"

namespace strata::transparency {

Frame only(const Frame& frame, Resolution resolution) {
    Frame left = frame;
    const auto is_other = [&](const auto& submission) { return submission.resolution != resolution; };
    std::erase_if(left.draws, is_other);
    std::erase_if(left.emitters, is_other);
    return left;
}

ReferenceImage blended_at_full_resolution(ReferenceImage color, const StageInput& input, const PlacedBlend& blend) {
    if (!frame_features(input.frame).has(Feature::low_resolution)) return blended(std::move(color), input, blend);
    const Frame full = only(input.frame, Resolution::full);
    return blended(std::move(color), {full, input.before}, blend);
}

ReferenceImage farthest_depth(const ReferenceImage& fine, Extent extent) {
    ReferenceImage coarse(extent.width, extent.height, 1, glm::dvec4(1));
    for (std::uint32_t y = 0; y < coarse.height; ++y)
        for (std::uint32_t x = 0; x < coarse.width; ++x)
            for (std::uint32_t s = 0; s < fine.layers; ++s)
                for (std::uint32_t v = y * fine.height / coarse.height; v * coarse.height < (y + 1) * fine.height; ++v)
                    for (std::uint32_t u = x * fine.width / coarse.width; u * coarse.width < (x + 1) * fine.width; ++u)
                        coarse.at(x, y) = glm::min(coarse.at(x, y), fine.at(u, v, s));
    return coarse;
}

std::optional<FragmentLists> low_fragments(const StageInput& input) {
    if (!frame_features(input.frame).has(Feature::low_resolution)) return std::nullopt;
    Frame frame = only(input.frame, Resolution::low);
    View& view = frame.view;
    const Extent extent = prepass_extent({view.width, view.height}, 2);
    view.width = extent.width, view.height = extent.height, view.samples = 1;
    return fragments_before(frame, farthest_depth(opaque_depth(input.before, input.before.at("color")), extent), input.before);
}

}  // namespace strata::transparency
