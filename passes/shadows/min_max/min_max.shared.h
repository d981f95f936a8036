// What the C++ and the shaders of shadows/min_max share.
#ifndef PASSES_SHADOWS_MIN_MAX_SHARED_H
#define PASSES_SHADOWS_MIN_MAX_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::shadows {
#endif

// The parameter form.
const uint form_hierarchical = 0u;
const uint form_block = 1u;
const uint form_overlapping = 2u;
const uint form_plane = 3u;
const uint form_slab = 4u;

// The rows of the table of classes.
struct ClassRowsPush {
    uint slots;  // maps
};

#ifdef __cplusplus
}
#endif
#endif
