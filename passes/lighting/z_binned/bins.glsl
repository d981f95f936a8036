// From view depth to its bin. bin_of() never falls as z grows, so a light from z0 to z1 is found by every z between them.
#ifndef PASSES_LIGHTING_Z_BINNED_BINS_GLSL
#define PASSES_LIGHTING_Z_BINNED_BINS_GLSL
#include "passes/lighting/z_binned/z_binned.shared.h"

// Relative room a light gets on both sides with logarithmic bins: a device's logarithm need not be monotone to the last bit.
const float logarithm_slack = 1e-5;

uint bin_of(ZHeader header, ZBinsPush push, float z) {
    const float way = push.spacing == spacing_logarithmic ? log(max(z, header.near) / header.near) : z - header.near;
    return uint(clamp(way * header.scale, 0.0, float(push.bins - 1u)));
}

float slack_of(ZBinsPush push) { return push.spacing == spacing_logarithmic ? logarithm_slack : 0.0; }

// Bits of word `word` of a mask that lie in low..high.
uint bits_between(uint low, uint high, uint word) {
    const uint first = word * 32u;
    if (high < first || low > first + 31u || low > high) return 0u;
    const uint from = low > first ? low - first : 0u;
    const uint to = min(high - first, 31u);
    return (0xffffffffu << from) & (0xffffffffu >> (31u - to));
}

#endif
