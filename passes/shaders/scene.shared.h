// The scene on the device: records of the buffers that scene.glsl declares and every shader gets without binding them.
// Everything is in view space (+x right, +y up, +z forward, metres), made camera-relative in double on the CPU.
#ifndef PASSES_SHADERS_SCENE_SHARED_H
#define PASSES_SHADERS_SCENE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {  // no_index is capture_format/frame.h's
#else
const uint no_index = 0xffffffffu;
#endif

// Lighting models and alpha modes have the values of capture_format/frame.h.
const uint model_unlit = 0u;
const uint model_lambert = 1u;
const uint model_burley = 2u;
const uint model_ggx = 3u;
const uint model_cloth = 4u;
const uint model_skin = 5u;
const uint model_hair = 6u;
const uint model_plain_burley = 7u;
const uint model_multiscatter_ggx = 8u;
const uint alpha_opaque = 0u;
const uint alpha_mask = 1u;
const uint alpha_blend = 2u;
const uint alpha_premultiplied = 3u;
const uint alpha_additive = 4u;

// What the way through fog is: view depth, or distance from the eye.
const uint fog_by_view_depth = 0u;
const uint fog_by_distance = 1u;

struct ViewRecord {
    mat4 projection;  // view to clip, jitter included; reversed depth, infinite far
    mat3 to_world;    // rotation, view to world (its transpose goes back)
    vec2 ndc_scale;   // P00, P11
    vec2 ndc_offset;  // P20, P21 with jitter: ndc (+y up) = scale * p.xy / p.z + offset
    uvec2 extent;
    uint samples;
    float near;
    float exposure;
    float white;      // of the tone curve
    vec3 background;  // radiance where no surface is
    float fog_density;
    vec3 fog_color;
    uint fog_path;       // fog_by_...
    vec3 sky;            // hemisphere radiance from above (world +y) ...
    vec3 ground;         // ... and below
    uint light_count;    // of lights, the sun first when there is one
    uint shadow_count;   // of shadows
    uint first_emitter;  // of draws, which are emitters from here on
    uint seed;
    uint frame_index;
    float time;
};

struct DrawRecord {
    mat4 to_view;  // object to view
    mat3 normal_to_view;
    uint material;
    float soft_fade;  // metres; 0 is hard
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

// Kinds of textures that a material has.
const uint base_color_texture = 0u;
const uint metallic_roughness_texture = 1u;
const uint normal_texture = 2u;
const uint emissive_texture = 3u;
const uint occlusion_texture = 4u;
const uint texture_kinds = 5u;

struct TextureUseRecord {
    uint texture;  // no_index: none, white
    uint uv_set;
    vec3 row0;  // u' = dot(row0, (u, v, 1))
    vec3 row1;
};

struct MaterialRecord {
    vec4 base_color;
    vec3 emissive;
    float metallic;
    vec3 transmission;
    float roughness;
    uint lighting_model;
    uint alpha_mode;
    float mask_cutoff;
    float normal_scale;
    float occlusion_strength;
    float distortion;
    uint double_sided;
    TextureUseRecord textures[texture_kinds];  // by kind
};

// Texels lie in one buffer: rgba8 is one uint, rgba16f two, rgba32f four. Mips follow each other, finest first.
struct TextureRecord {
    uint first;   // index of the first uint in texels
    uint format;  // TextureFormat of capture_format/frame.h
    uint width;
    uint height;
    uint mips;
    uint address;  // AddressMode along u, and along v two bits higher
};

struct LightRecord {
    vec3 position;   // view space
    uint type;       // LightType of capture_format/frame.h; the sun is directional
    vec3 direction;  // where it shines
    float range;
    vec3 intensity;  // W/sr; irradiance when directional
    float source_radius;
    vec3 axis_u;  // with axis_v = cross(direction, axis_u)
    float cos_inner;
    float cos_outer;
    vec2 tan_half;          // of a square spot or a projected picture: half its width and height at unit distance
    vec2 half_extent;       // rectangle; half length of a tube in x
    uint texture;           // projected or emitted, no_index without
    uint features;          // bits of light_features.shared.h that every evaluation of it needs
    uint first_blocker;     // in light_blockers ...
    uint blockers;          // ... how many, at most 32
    uint first_portal;      // in blocker_portals ...
    uint portals;           // ... how many, at most 32
    uint first_clip;        // in clip_planes ...
    uint clips;             // ... how many, at most 6
    uint shadow;            // first slot in shadows, no_index without
    uint shadow_slots;      // cascades of the sun, 1 for spots, 6 for omni
    uint visibility_layer;  // its first layer (sample 0) in the visibility image, no_index without
};

// A rectangle that stops light, in view space: center +- u half_u +- v half_v, v = cross(normal, u).
struct BlockerRecord {
    vec3 normal;
    float half_u;
    vec3 center;
    float half_v;
    vec3 u;
    uint one_sided;  // stops only light from the normal's side
};

// One of the blockers of one light. Bit k of portals: the light's k-th portal is a hole in it.
struct LightBlockerRecord {
    uint blocker;
    uint portals;
};

// A hole, in the (u, v) frame of the blocker it is cut into (a portal through two faces of a wall is two records).
struct BlockerPortalRecord {
    vec2 center;
    vec2 half_extent;
    vec2 turn;     // cosine and sine from the blocker's u to the portal's
    uint blocker;  // index into blockers
};

// Keeps what lies on the side dot(normal, p) + distance >= 0, view space.
struct ClipPlaneRecord {
    vec3 normal;
    float distance;
};

// One shadow map: a square of a layer of shadow_maps. The buffer has the maps of Allocation::own, then as many of ::need
// (passes/scene/shadow_views.h); slots count from the first of either.
struct ShadowRecord {
    mat4 view_to_map;   // view space to (u, v, depth, w): uv in 0..1 of this map, depth 1 at the light, 0 far
    uint light;         // index into lights
    uint size;          // texels per edge
    float bias;         // metres towards the light
    float range_begin;  // view depth from which this cascade serves
    float range_end;
    float texel;         // world size of a texel at unit distance (spots, omni) or anywhere (sun), metres
    float source_width;  // of the light, metres; of the sun per metre from the caster
    uvec2 offset;        // of its upper left texel in the layer
    uint layer;
};

#ifdef __cplusplus
}
#endif
#endif
