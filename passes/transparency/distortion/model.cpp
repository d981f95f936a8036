#include "passes/transparency/distortion/model.h"

#include "capture_format/frame_features.h"
#include "passes/stage_input.h"
#include "passes/transparency/low_resolution/bilinear_taps.h"

namespace strata::transparency {

BlendedSample seen_behind(const ReferenceImage& behind, glm::uvec3 at, glm::dvec2 offset) {
    const glm::uvec2 extent(behind.width, behind.height);
    BlendedSample seen;
    for (const Tap& tap : bilinear_taps(place_of(glm::uvec2(at), extent) + offset, extent)) {
        seen.radiance += glm::dvec3(behind.at(tap.x, tap.y, at.z)) * tap.share;
        if (!behind.undecided.empty() && behind.undecided[behind.index(tap.x, tap.y, at.z)]) seen.undecided = true;
    }
    return seen;
}

ReferenceImage background(const StageInput& input) {
    const ReferenceImage& behind = input.before.at("color");
    if (!frame_features(input.frame).has(Feature::distortion)) return behind;
    const SampleBlend add_offsets = [](std::span<const Fragment> fragments, glm::dvec3 offset) {
        for (const Fragment& f : fragments) offset = glm::dvec3(f.distortion, 0) + luminance(f.transmittance) * offset;
        return offset;
    };
    const ReferenceImage none(behind.width, behind.height, behind.layers);
    const ReferenceImage offsets = blended_by_object(none, input, add_offsets);
    ReferenceImage bent = behind;
    bent.undecided = offsets.undecided;
    for (std::uint32_t s = 0; s < behind.layers; ++s)
        for (std::uint32_t y = 0; y < behind.height; ++y)
            for (std::uint32_t x = 0; x < behind.width; ++x) {
                const BlendedSample seen = seen_behind(behind, {x, y, s}, glm::dvec2(offsets.at(x, y, s)));
                bent.at(x, y, s) = glm::dvec4(seen.radiance, behind.at(x, y, s).w);
                if (seen.undecided) bent.undecided[bent.index(x, y, s)] = true;
            }
    return bent;
}

}  // namespace strata::transparency
