#include "passes/transparency/sample_blend.h"

#include <algorithm>

namespace strata::transparency {
namespace {

/// Opaque depth per sample; nothing is in front of anything where the frame has no opaque depth.
ReferenceImage opaque_depth(const ImageSet& before, const ReferenceImage& color) {
    const auto found = before.find("depth_layers");
    return found != before.end() ? found->second : ReferenceImage(color.width, color.height, color.layers);
}

}  // namespace

ReferenceImage blended(ReferenceImage color, const Frame& frame, const ImageSet& before, const SampleBlend& blend,
                       const SampleDoubt& doubtful) {
    const FragmentLists lists = transparent_fragments(frame, opaque_depth(before, color));
    if (color.undecided.empty()) color.undecided.assign(color.texels.size(), false);
    for (std::uint32_t s = 0; s < color.layers; ++s) {
        for (std::uint32_t y = 0; y < color.height; ++y) {
            for (std::uint32_t x = 0; x < color.width; ++x) {
                glm::dvec4& texel = color.at(x, y, s);
                const std::span<const Fragment> fragments = lists.at(x, y, s);
                texel = glm::dvec4(blend(fragments, glm::dvec3(texel)), texel.w);
                if (lists.undecided(x, y, s) || (doubtful && doubtful(fragments))) color.undecided[color.index(x, y, s)] = true;
            }
        }
    }
    return color;
}

std::vector<Fragment> nearest_first(std::span<const Fragment> in_submission_order) {
    std::vector<Fragment> sorted(in_submission_order.rbegin(), in_submission_order.rend());
    std::ranges::stable_sort(sorted, std::ranges::less{}, &Fragment::depth);
    return sorted;
}

}  // namespace strata::transparency
