// The technique in double precision. What it stores is rounded to the stored formats: that is part of it.
#pragma once

#include <span>

#include "passes/image_set.h"
#include "passes/reference/fragments.h"
#include "passes/transparency/a_buffer/a_buffer.shared.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// To the nearest R11G11B10F, R16F (not negative) and R8_UNORM.
glm::dvec3 nearest_r11g11b10(glm::dvec3);
double nearest_half(double);
double nearest_unorm8(double);

enum class StoredAs { mono, rgb };

/// One sample, its fragments in submission order.
glm::dvec3 a_buffer_blend(std::span<const Fragment>, glm::dvec3 behind, std::size_t layers, StoredAs);

ImageSet a_buffer_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
