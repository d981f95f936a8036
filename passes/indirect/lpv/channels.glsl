// Channels of light that a cell holds: red, green and blue, and with self_facing three more by the way that the light's sources face. These
// hold the mean of red, green and blue, each source weighted by (1 + n.x) / 2, (1 + n.y) / 2 and (1 + n.z) / 2 of its normal n: never less
// than nothing, and no brightness that red, green and blue do not have.
#ifndef PASSES_INDIRECT_LPV_CHANNELS_GLSL
#define PASSES_INDIRECT_LPV_CHANNELS_GLSL
#include "passes/indirect/lpv/lpv.shared.h"

layout(constant_id = 97) const uint channels = color_channels;

bool knows_facing() { return channels > color_channels; }

#endif
