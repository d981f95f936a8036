#include "passes/transparency/sample_blend.h"

#include <algorithm>
#include <utility>

namespace strata::transparency {
namespace {

/// Opaque depth per sample; nothing is in front of anything where the frame has no opaque depth.
ReferenceImage opaque_depth(const ImageSet& before, const ReferenceImage& color) {
    const auto found = before.find("depth_layers");
    return found != before.end() ? found->second : ReferenceImage(color.width, color.height, color.layers);
}

}  // namespace

ReferenceImage blended(ReferenceImage color, const Frame& frame, const ImageSet& before, const SampleBlend& blend) {
    return blended(std::move(color), frame, before, [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3) {
        return BlendedSample{blend(fragments, behind)};
    });
}

ReferenceImage blended(ReferenceImage color, const Frame& frame, const ImageSet& before, const PlacedBlend& blend) {
    const FragmentLists lists = transparent_fragments(frame, opaque_depth(before, color));
    if (color.undecided.empty()) color.undecided.assign(color.texels.size(), false);
    for (std::uint32_t s = 0; s < color.layers; ++s) {
        for (std::uint32_t y = 0; y < color.height; ++y) {
            for (std::uint32_t x = 0; x < color.width; ++x) {
                glm::dvec4& texel = color.at(x, y, s);
                const BlendedSample result = blend(lists.at(x, y, s), glm::dvec3(texel), {x, y, s});
                texel = glm::dvec4(result.radiance, texel.w);
                if (lists.undecided(x, y, s) || result.undecided) color.undecided[color.index(x, y, s)] = true;
            }
        }
    }
    return color;
}

double coverage(const Fragment& f) { return 1 - (f.transmittance.x + f.transmittance.y + f.transmittance.z) / 3; }

glm::dvec3 transmittance_before(std::span<const Fragment> fragments, double depth) {
    glm::dvec3 through(1);
    for (const Fragment& fragment : fragments)
        if (fragment.depth < depth) through *= fragment.transmittance;
    return through;
}

std::vector<Fragment> nearest_first(std::span<const Fragment> in_submission_order) {
    std::vector<Fragment> sorted(in_submission_order.rbegin(), in_submission_order.rend());
    std::ranges::stable_sort(sorted, std::ranges::less{}, &Fragment::depth);
    return sorted;
}

}  // namespace strata::transparency
