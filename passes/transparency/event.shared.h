// What a frame's transparent surfaces are, as bits of the constant `drawn` of event.glsl.
#ifndef PASSES_TRANSPARENCY_EVENT_SHARED_H
#define PASSES_TRANSPARENCY_EVENT_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

const uint meshes_drawn = 1u;
const uint particles_drawn = 2u;

#ifdef __cplusplus
}
#endif
#endif
