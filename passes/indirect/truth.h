// The truth of indirect light: irradiance / pi that arrives at each sample by exactly one bounce, gathered in double from the
// surfaces that earlier stages gave, so that this stage is judged alone. Of two bounces: what arrives by one or by two.
//
// Rays leave a sample in directions distributed by the cosine. What they hit, either face of any opaque or masked draw, reflects
// direct light (direct_light.h) as Lambert's surface of albedo base color (1 - metallic) does, whatever its lighting model,
// about its interpolated vertex normal. Unlit surfaces reflect nothing. Emission is not gathered: emissive surfaces are no
// lights, here as in every other stage. Light from the hemisphere does not bounce. A ray that a blocker cuts (leg_blockers.h)
// brings nothing.
#pragma once

#include "passes/image_set.h"
#include "passes/reference/image.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// Directions over a sample: `batches` independent sets of side x side, each with one direction in every part of the hemisphere.
/// A path of two bounces goes on in one direction from the surface that it reaches.
struct GatheredDirections {
    std::uint32_t side = 20, batches = 4;
    std::uint32_t bounces = 1;  ///< light that arrives by as many or fewer
};
/// The standard error at these 1600 directions, relative to the truth's root mean square: 2.3 % on cornell_box, 1.1 % on
/// two_rooms (of two bounces 2.4 % and 1.3 %), which is below a tenth of what is known of light propagation volumes (30 %,
/// docs/algorithms/lighting.md 5.8).
inline constexpr GatheredDirections truth_directions{};

/// Irradiance / pi, with its standard error by how much the batches differ (0 of a single one); a is 1 on a surface, all is 0
/// where there is none. Equal for equal inputs, whatever the number of threads.
ReferenceImage gathered_light(const StageInput&, const GatheredDirections& = truth_directions);

ImageSet indirect_truth(const StageInput&);
ImageSet two_bounce_truth(const StageInput&);

}  // namespace strata
