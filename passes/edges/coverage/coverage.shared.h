// What the coverage test's C++ and its shaders share.
#ifndef PASSES_EDGES_COVERAGE_SHARED_H
#define PASSES_EDGES_COVERAGE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::edges {
#endif

const uint coverage_alone = 0u;
const uint coverage_and_depth = 1u;
const uint coverage_and_material = 2u;
const uint coverage_and_both = 3u;

struct CoverageParams {
    uint with_tests;
    float depth_step;
    float color_step;
};

#ifdef __cplusplus
}
#endif
#endif
