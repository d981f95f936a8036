// The technique in double precision, from the paper and not from the shader.
#pragma once

#include <span>

#include "passes/image_set.h"
#include "passes/reference/fragments.h"
#include "passes/transparency/multi_layer/multi_layer.shared.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// One sample: fragments in submission order into `layers` nodes, composited over what is behind.
glm::dvec3 multi_layer_blend(std::span<const Fragment>, glm::dvec3 behind, std::uint32_t layers);

ImageSet multi_layer_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
