// Half floats end here: past it hardware adds to infinity and lavapipe 22.3 stays. And infinity times nothing is not a number.
#ifndef PASSES_SHADERS_LARGEST_HALF_GLSL
#define PASSES_SHADERS_LARGEST_HALF_GLSL

const float largest_half = 65504.0;

#endif
