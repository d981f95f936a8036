// Which draws stand in the scene's opaque lists, and in which order: one place for the scene, the models and the truths.
#pragma once

#include <cstdint>
#include <vector>

#include "capture_format/frame.h"
#include "passes/reference/fragments.h"  // opaque_draws: command i of FrameImages::all_opaque draws the i-th of them

namespace strata {

/// Those of opaque_draws() that cast shadows, in the same order: command i of FrameImages::casters.
std::vector<std::uint32_t> caster_draws(const Frame&);

}  // namespace strata
