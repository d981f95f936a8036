// The technique in double precision. What it stores is rounded as the technique says: that is part of it.
#pragma once

#include <span>

#include "passes/image_set.h"
#include "passes/reference/fragments.h"
#include "passes/transparency/k_buffer/k_buffer.shared.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// A fragment as 64 bits, smaller is nearer. `nudge` moves depth, coverage and color by that many roundings of a float.
std::uint64_t k_buffer_key(const Fragment&, double nudge = 0);

/// One sample, its fragments in submission order.
glm::dvec3 k_buffer_blend(std::span<const Fragment>, glm::dvec3 behind, const KBufferParams&);

ImageSet k_buffer_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
