// The technique in double precision, from the talk and not from the shader. What is stored in bytes is rounded at every blend, in
// the order of submission: that is the technique. Half floats end at 65504.
#pragma once

#include <optional>
#include <span>

#include "passes/blend_rounding.h"
#include "passes/image_set.h"
#include "passes/reference/fragments.h"
#include "passes/transparency/weighted_additive/weighted_additive.shared.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// What the targets of one sample hold.
struct AdditiveSums {
    glm::dvec3 colors{0}, emissions{0};  ///< weighted; published: both in colors
    double weights = 0, emission_weights = 0;
    glm::dvec3 reveal{1};
    double additiveness = 0;  ///< layers / 8

    AdditiveSums& operator+=(const AdditiveSums&);
    friend AdditiveSums operator*(const AdditiveSums&, double share);
};

/// max(depth term) is 20 up to 4.3 m, 5 from `far` on.
double additive_depth_weight(const WeightedAdditiveParams&, double z);
/// With the opacity term; exposure scales emission.
double additive_weight(const WeightedAdditiveParams&, double exposure, const Fragment&);

/// Fragments of one sample, in order of submission. With `half` what is kept in half floats is rounded at every blend, too.
AdditiveSums summed(std::span<const Fragment>, const WeightedAdditiveParams&, double exposure, std::optional<Rounding> half = {});
/// Two resolutions of the same place.
AdditiveSums merged(const AdditiveSums&, const AdditiveSums&);
glm::dvec3 composite(const AdditiveSums&, glm::dvec3 behind, const WeightedAdditiveParams&);

ImageSet weighted_additive_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
