// A convex cell of view space: the part of a tile between two depths, which culling and blocker classification ask about.
#ifndef PASSES_LIGHTING_CELL_GLSL
#define PASSES_LIGHTING_CELL_GLSL

struct Cell {
    vec3 corners[8];  // bit 0: right, bit 1: lower edge on screen, bit 2: far
    vec4 planes[6];   // inward: left, right, bottom, top (through the eye), near, far
    float z_near;     // view z, meters
    float z_far;
};

#endif
