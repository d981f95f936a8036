// Parameters that every G-buffer technique takes: how triangles are drawn into it, whatever its layout.
#ifndef PASSES_GBUFFER_FILL_SHARED_H
#define PASSES_GBUFFER_FILL_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::gbuffer {
#endif

// Where attributes are shaded: once per pixel and triangle at the pixel's center, or for every sample at its own place.
const uint attributes_at_center = 0u;
const uint attributes_at_sample = 1u;

struct FillParams {
    uint attributes;
    uint masked;  // a method of passes/gbuffer/coverage/coverage.shared.h
};

#ifdef __cplusplus
}
#endif
#endif
