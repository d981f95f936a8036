// A vertex of a surface that stops light between cells.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/surfels/surfel_vertex.glsl"
