// The scene's buffers, offered to every shader by their block names. Include it and use what you need: what a shader does not
// use is neither bound nor uploaded for it.
#ifndef PASSES_SHADERS_SCENE_GLSL
#define PASSES_SHADERS_SCENE_GLSL
#extension GL_EXT_scalar_block_layout : require
#include "passes/shaders/ltc.shared.h"
#include "passes/shaders/scene.shared.h"

// A uniform block: llvmpipe reads it once for all lanes of a vector, and a storage buffer lane by lane.
layout(set = 1, binding = 0, scalar) uniform View { ViewRecord view; };
layout(set = 1, binding = 1, scalar) readonly buffer VertexPositions { vec3 vertex_positions[]; };
layout(set = 1, binding = 2, scalar) readonly buffer Draws { DrawRecord draws[]; };
layout(set = 1, binding = 3, scalar) readonly buffer Materials { MaterialRecord materials[]; };
layout(set = 1, binding = 4, scalar) readonly buffer Textures { TextureRecord textures[]; };
layout(set = 1, binding = 5, scalar) readonly buffer Texels { uint texels[]; };
layout(set = 1, binding = 6, scalar) readonly buffer Lights { LightRecord lights[]; };
layout(set = 1, binding = 7, scalar) readonly buffer Shadows { ShadowRecord shadows[]; };
layout(set = 1, binding = 8, scalar) readonly buffer Blockers { BlockerRecord blockers[]; };
layout(set = 1, binding = 9, scalar) readonly buffer LightBlockers { LightBlockerRecord light_blockers[]; };
layout(set = 1, binding = 10, scalar) readonly buffer BlockerPortals { BlockerPortalRecord blocker_portals[]; };
layout(set = 1, binding = 11, scalar) readonly buffer ClipPlanes { ClipPlaneRecord clip_planes[]; };
layout(set = 1, binding = 12, scalar) readonly buffer LtcTable { LtcRecord ltc_table[]; };
layout(set = 1, binding = 13, scalar) readonly buffer Indices { uint indices[]; };
layout(set = 1, binding = 14, scalar) readonly buffer VertexNormals { vec3 vertex_normals[]; };
layout(set = 1, binding = 15, scalar) readonly buffer VertexTangents { vec4 vertex_tangents[]; };
layout(set = 1, binding = 16, scalar) readonly buffer VertexUvs { vec2 vertex_uvs[]; };
layout(set = 1, binding = 17, scalar) readonly buffer VertexColors { vec4 vertex_colors[]; };
// Of particles, whose corners are in view space: xy of two corners each (passes/shaders/vertex.glsl), and the depth of all four.
layout(set = 1, binding = 18, scalar) readonly buffer ParticleBottoms { vec4 particle_bottoms[]; };
layout(set = 1, binding = 19, scalar) readonly buffer ParticleTops { vec4 particle_tops[]; };
layout(set = 1, binding = 20, scalar) readonly buffer ParticleDepths { float particle_depths[]; };
layout(set = 1, binding = 21, scalar) readonly buffer ParticleUvs { vec4 particle_uvs[]; };      // origin and size
layout(set = 1, binding = 22, scalar) readonly buffer ParticleGlows { vec4 particle_glows[]; };  // w: meters towards the eye
// Of the frame, in the order of their blockers: each a hole in the blocker that it names.
layout(set = 1, binding = 23, scalar) readonly buffer Portals { BlockerPortalRecord portals[]; };

#endif
