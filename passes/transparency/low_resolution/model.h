// Half-resolution draws in double: what they add up to, and what a pixel of the frame reads of it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "passes/transparency/low_resolution/bilinear_taps.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {

/// The frame with the draws and emitters of one resolution alone.
Frame only(const Frame&, Resolution);

/// blended() without what is drawn at half resolution.
ReferenceImage blended_at_full_resolution(ReferenceImage color, const StageInput&, const PlacedBlend&);

/// Half-resolution fragments in front of the farthest opaque depth of their pixels; none where nothing is drawn so.
std::optional<FragmentLists> low_fragments(const StageInput&);

/// The farthest opaque depth of every texel of a smaller image, of all samples (reversed: the smallest number).
ReferenceImage farthest_depth(const ReferenceImage&, Extent);

/// What low-resolution fragments are summed to, texel by texel, and its bilinear reading. Sums{} is that of no fragment; it has
/// += and * double.
template <typename Sums>
class LowSums {
public:
    struct Texel {
        Sums sums;
        bool undecided = false;
    };
    using Sum = std::function<Texel(std::span<const Fragment>, glm::uvec2 texel)>;

    LowSums(const StageInput& input, const Sum& sum) {
        const std::optional<FragmentLists> lists = low_fragments(input);
        if (!lists) return;
        extent_ = {lists->width(), lists->height()};
        for (std::uint32_t y = 0; y < extent_.y; ++y)
            for (std::uint32_t x = 0; x < extent_.x; ++x) {
                texels_.push_back(sum(lists->at(x, y), {x, y}));
                texels_.back().undecided = texels_.back().undecided || lists->undecided(x, y);
            }
    }

    /// place: 0 to 1 each way.
    Texel at(glm::dvec2 place) const {
        if (texels_.empty()) return {};
        const auto taps = bilinear_taps(place, extent_);
        Texel read{texel(taps[0]).sums * taps[0].share, texel(taps[0]).undecided};
        for (std::size_t i = 1; i < taps.size(); ++i) {
            read.sums += texel(taps[i]).sums * taps[i].share;
            read.undecided = read.undecided || texel(taps[i]).undecided;
        }
        return read;
    }

private:
    const Texel& texel(const Tap& tap) const { return texels_[tap.y * extent_.x + tap.x]; }

    glm::uvec2 extent_{0};
    std::vector<Texel> texels_;
};

}  // namespace strata::transparency
