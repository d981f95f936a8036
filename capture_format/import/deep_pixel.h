// The samples of one deep pixel as transparency needs them: good numbers only, nearest first, volumes cut where they overlap
// and merged where they coincide ("Interpreting OpenEXR Deep Pixels", Hillman 2013).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/import/deep.h"
#include "capture_format/import/deep_file.h"

namespace strata {

/// A sample nearer than this is put there, one farther is infinitely far: device depth, near over z, must not underflow in a
/// float between the two.
inline constexpr double nearest_depth = 1e-15, farthest_depth = 1e15;

/// A sample, or a cut of a volume. Colors are premultiplied: L_out = color + (1 - alpha) L_behind, channel by channel.
struct DeepSample {
    double depth = 0, back = 0;  ///< equal for a point; both infinite for what lies behind everything
    glm::dvec3 color{0}, alpha{0};
    std::uint32_t index = 0;  ///< place in the pixel, as stored
};

/// Samples begin[pixel] to begin[pixel + 1] of the block: nearest first, of equal depths the thinner one first and then the
/// earlier in the file; volumes are cut. Adds to the census what was counted on the way (but not what depends on the frame).
/// Fails as check_cuts() does.
Result<std::vector<DeepSample>> pixel_samples(const DeepBlock&, std::size_t pixel, DeepCensus&);

/// Fails where volumes overlap so often that cutting them would take for ever.
Result<void> check_cuts(const DeepCensus&);

/// Cuts the volumes among sorted samples wherever another sample begins or ends inside them, and merges equal cuts: optical
/// depths add, and each adds light in proportion to its share of the cut. Points stay as they are.
std::vector<DeepSample> without_overlaps(const std::vector<DeepSample>& nearest_first);
bool any_overlap(const std::vector<DeepSample>& nearest_first);

/// L_out of sorted samples over black, in double; w is the alpha, averaged over the channels.
glm::dvec4 composite(const std::vector<DeepSample>& nearest_first);

}  // namespace strata
