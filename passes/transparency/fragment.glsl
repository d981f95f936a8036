// The transparent fragment under a sample, from the varyings of draw.vert: L_out = p + e + t L_behind
// (docs/algorithms/transparency.md 0.1), with L_behind seen d away (6.13).
// Every technique draws the same fragments; they differ in how they combine them. gl_SampleID makes the shader run per sample.
// fragment_draw.h binds what is declared here. Call transparent_fragment() before any branch that leaves the 2x2 quad.
#ifndef PASSES_TRANSPARENCY_FRAGMENT_GLSL
#define PASSES_TRANSPARENCY_FRAGMENT_GLSL
#include "passes/indirect/volume_light.glsl"
#include "passes/shaders/blockers.glsl"
#include "passes/shaders/camera.glsl"
#include "passes/shaders/lights.glsl"
#include "passes/shaders/ordering.shared.h"
#include "passes/transparency/fragment_material.glsl"
#include "passes/transparency/sanitize.glsl"

layout(location = 0) sample in vec3 in_position;
layout(location = 1) sample in vec3 in_normal;
layout(location = 2) sample in vec4 in_tangent;
layout(location = 3) sample in vec4 in_uv;
layout(location = 4) sample in vec4 in_color;
layout(location = 5) sample in vec4 in_emissive;  // of particles; w: depth offset towards the eye
layout(location = 6) flat in uint in_draw;
layout(location = 7) flat in uint in_triangle;   // its number in the draw, where FrameImages::numbered is drawn; else 0

layout(constant_id = 1) const uint soft_fade = 0u;      // 1: the frame has soft particles and depth_layers is bound
layout(constant_id = 2) const float sample_near = 0.0;  // the near plane; 0: varyings are the sample's
layout(constant_id = 4) const uint distorts = 0u;        // 1: the frame has materials that distort
layout(constant_id = 8) const uint has_interfaces = 0u;  // 1: the frame has interface layers
layout(constant_id = 14) const uint has_fog = 1u;        // 0: the frame has none
layout(constant_id = 22) const uint light_features = every_light_feature;
layout(set = 0, binding = 0) uniform sampler2DArray depth_layers;

struct Fragment {
    float z;       // view depth, depth offset applied, or an interface layer's: what ordering uses
    float alpha;   // scalar coverage
    vec3 p, t, e;  // premultiplied scattered radiance, transmittance, emission; fog is in them
    vec2 d;        // distortion: how far away, in uv, what is behind is seen
    bool visible;
};

// What takes a varying to the sample. lavapipe 22.3 interpolates `sample` varyings there but divides by the w of the pixel's
// center: on a tilted surface a constant 1 is half a percent off. gl_FragCoord.z is the sample's, and where in_position.z is,
// too, this is 1. A constant and not view.near: helper lanes read zeros from buffers there, and uv needs its derivatives.
float to_sample() { return sample_near > 0.0 ? sample_near / (gl_FragCoord.z * in_position.z) : 1.0; }

vec3 position_here() { return in_position * to_sample(); }

// How much of a soft particle is left this far in front of the opaque surface behind it.
float faded() {
    const float meters = soft_fade_meters();
    if (soft_fade == 0u || meters <= 0.0) return 1.0;
    const float opaque = texelFetch(depth_layers, ivec3(gl_FragCoord.xy, gl_SampleID), 0).r;
    return opaque > 0.0 ? clamp((view_z(opaque) - position_here().z) / meters, 0.0, 1.0) : 1.0;
}

// Whether no blocker stops the light.
bool reached(LightRecord light, MaterialPoint m) {
    if ((light_features & feature_blockers) == 0u || light.blockers == 0u) return true;
    const vec3 above = off_surface(m.position, facing_normal(m.lighting_model, m.normal, m.position));
    return blockers_pass(light, above, low_bits(light.blockers), low_bits(light.portals));
}

// Of light volumes: what a diffuse surface reflects, as an opaque one at its place does.
vec3 from_volumes(MaterialPoint m) {
    const vec3 normal = facing_normal(m.lighting_model, m.normal, m.position);
    return m.base_color * ((1.0 - m.metallic) * m.occlusion) *
           volume_light_at(LitPlace(view.to_world * m.position, view.to_world * normal));
}

// A particle has no side: it scatters the mean radiance of all directions evenly. Its color is radiance; over that of a white
// surface, and at most 1, it is the albedo.
vec3 from_volumes_around(vec3 color) {
    if (view.white_level == 0.0) return vec3(0.0);
    return clamp(color / view.white_level, 0.0, 1.0) * volume_light_at(LitPlace(view.to_world * position_here(), vec3(0.0)));
}

vec3 unlit(MaterialPoint m) { return m.base_color * view.pre_exposure; }

// All lights as their blockers let them through, without shadows, sky and ground, and light volumes; an unlit material is its own
// light.
vec3 lit(MaterialPoint m) {
    if (used_models == 1u << model_unlit) return unlit(m);  // by itself: a branch on constants alone, which leaves out what follows
    if (m.lighting_model == model_unlit) return unlit(m);
    vec3 sum = hemisphere_light(m);
    for (uint i = 0u; i < view.light_count; ++i)
        if (reached(lights[i], m)) sum += reflected(m, lights[i], light_features);
    if (light_grids > 0u) sum += from_volumes(m);
    return sum;
}

Fragment blended(float alpha, vec3 p, vec3 transmission) {
    return Fragment(position_here().z, alpha, p, 1.0 - alpha * (1.0 - transmission), vec3(0.0), vec2(0.0), true);
}

Fragment additive(vec3 e) { return Fragment(position_here().z, 0.0, vec3(0.0), vec3(1.0), e, vec2(0.0), true); }

Fragment mesh_fragment(MaterialPoint m) {
    const float a = valid_alpha(m.alpha);
    const vec3 scattered = lit(m);
    if (m.alpha_mode == alpha_additive) return additive(a * (scattered + m.emissive));
    if (m.alpha_mode == alpha_premultiplied) return blended(a, scattered + a * m.emissive, m.transmission);
    return blended(a, a * (scattered + m.emissive), m.transmission);
}

// m is the emitter's texture alone: the particle's color is kept out of it.
Fragment particle_fragment(MaterialPoint m) {
    const vec4 color = in_color * to_sample();
    const vec3 emissive = in_emissive.rgb * to_sample();
    const float fade = faded(), a = valid_alpha(color.a * m.alpha * fade);
    vec3 c = color.rgb * m.base_color;
    const vec3 e = emissive * m.base_color * (m.alpha * fade);
    if (light_grids > 0u) c += from_volumes_around(c);
    if (m.alpha_mode == alpha_additive) return additive(e + a * c);
    const vec3 p = m.alpha_mode == alpha_premultiplied ? c * (color.a * fade) : a * c;
    Fragment fragment = blended(a, p, vec3(0.0));
    fragment.e = e;
    return fragment;
}

float fog_before_here() { return fog_remains(fog_way(position_here(), view.fog_path)); }

// Fog between the eye and the fragment, before blending: sorted `over` of fogged fragments is then exact. What a fragment
// hides of the fog in front of it is 1 - t per channel; alpha is the same for gray fragments only
// (docs/algorithms/transparency.md 0.4).
void add_fog(inout Fragment fragment) {
    const float remains = fog_before_here();
    fragment.p = fragment.p * remains + (1.0 - fragment.t) * (1.0 - remains) * view.fog_color;
    fragment.e *= remains;
}

// 0: of the world.
uint interface_layer() { return has_interfaces != 0u ? layer_here() : 0u; }

// passes/reference/ordering.h has the same in double.
float ordering_depth(float z) {
    if (has_interfaces == 0u) return z;
    const uint layer = interface_layer();
    return layer > 0u ? layer_depth(view.near, layer) : max(z, view.near);
}

// glTF culls back faces in every alpha mode. A particle has none.
bool is_culled() { return !gl_FrontFacing && has_one_side(in_modes.z); }

// Adds nothing, hides nothing and bends nothing, also where a technique does not ask whether it is visible.
Fragment no_fragment() { return Fragment(position_here().z, 0.0, vec3(0.0), vec3(1.0), vec3(0.0), vec2(0.0), false); }

Fragment transparent_fragment() {
    const bool particle = is_emitter(in_draw);
    const float scale = to_sample();
    const vec4 color = particle ? vec4(1.0) : in_color * scale;
    const vec4 tangent = vec4(in_tangent.xyz, sign(in_tangent.w));
    const Varyings here = Varyings(position_here(), in_normal, tangent, color, gl_FrontFacing);
    const MaterialPoint m = material_point_here(in_draw, in_uv * scale, here);
    Fragment fragment = particle ? particle_fragment(m) : mesh_fragment(m);
    if (has_fog != 0u && view.fog_density > 0.0) add_fog(fragment);
    fragment.p = finite_or_zero(fragment.p);
    fragment.e = finite_or_zero(fragment.e);
    fragment.visible = is_finite(fragment.z) && !invisible(fragment.alpha, fragment.p, fragment.e);
    if (distorts != 0u && !particle) {
        fragment.d = distortion_here() * vec2(m.normal.x, -m.normal.y);
        fragment.visible = fragment.visible || is_finite(fragment.z) && fragment.d != vec2(0.0);
    }
    if (!particle && is_culled()) fragment = no_fragment();
    const float offset = drawn == meshes_drawn ? 0.0 : in_emissive.w * scale;
    fragment.z = ordering_depth(fragment.z - offset);
    return fragment;
}

#endif
