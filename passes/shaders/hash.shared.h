// Random numbers that C++ and GLSL draw alike, in integers only and with no state anywhere.
#ifndef PASSES_SHADERS_HASH_SHARED_H
#define PASSES_SHADERS_HASH_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
inline uint hashed(uint value);
inline uint hashed(uint key, uvec3 value);
#endif

// PCG as a hash (Jarzynski and Olano 2020, JCGT 9(3)).
uint hashed(uint value) {
    const uint state = value * 747796405u + 2891336453u;
    const uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

uint hashed(uint key, uvec3 value) { return hashed(hashed(hashed(key ^ value.x) ^ value.y) ^ value.z); }

#ifdef __cplusplus
}  // namespace strata
#endif
#endif
