// Draws on the device.
#ifndef PASSES_SHADERS_SCENE_DRAWS_SHARED_H
#define PASSES_SHADERS_SCENE_DRAWS_SHARED_H
#include "passes/shader_interop.h"
#include "passes/shaders/scene/no_index.shared.h"
#ifdef __cplusplus
namespace strata {
#endif

struct DrawRecord {
    mat4 to_view;  // object to view
    mat3 normal_to_view;
    uint material;
    float soft_fade;  // meters; 0 is hard
    uint layer;
    vec3 bound_center;  // view space sphere
    float bound_radius;
    mat4 motion;         // of a point in view space: how far it has moved since the frame before, seen by a camera that did not
    uint first_index;    // where its triangles begin in the list of indices
    uint vertex_offset;  // added to each of them; of a mesh its first place in vertex_positions
    // A mesh's first places in what its vertices have beside a position, no_index where they have none.
    uint normals;
    uint tangents;
    uint uv0;  // in vertex_uvs
    uint uv1;
    uint colors;          // a mesh has a color per vertex, an emitter one per particle
    uint first_particle;  // of an emitter, in what particles have
};

#ifdef __cplusplus
}
#endif
#endif
