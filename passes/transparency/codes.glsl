// Numbers as codes of fewer bits, rounded by the shader itself.
#ifndef PASSES_TRANSPARENCY_CODES_GLSL
#define PASSES_TRANSPARENCY_CODES_GLSL

// To nearest, but what lies halfway goes down however a float's last bit fell: .1, .3 and .5 do in 8 bits, and of a deep image's half
// floats every sixteenth in R11G11B10F and every fourth in RGB9E5. No such number lies near .503.
const float to_nearest = 0.497;

float power_of_two(int exponent) { return uintBitsToFloat(uint(exponent + 127) << 23); }

#endif
