// The wet surface in the place of the dry one, in the G-buffer's own layout (docs/algorithms/deferred.md 7.4 to 7.7). Included by
// compute shaders that store as many words as the layout has.
#include "passes/edges/plain_pixels.glsl"
#include "passes/gbuffer/packed_words.glsl"
#include "passes/gbuffer/surface_at.glsl"
#include "passes/gbuffer/encoders.glsl"
#include "passes/rain/wetness/water.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 7) const uint form = form_porosity;
layout(constant_id = 8) const float wet_albedo = 0.5;
layout(constant_id = 9) const float wet_gloss = 0.8;
layout(constant_id = 10) const float reach = 40.0;        // meters of view depth
layout(constant_id = 11) const float fade_begin = 20.0;  // meters
layout(constant_id = 12) const uint beyond = beyond_open;
layout(constant_id = 13) const uint ripple_filter = 1u;

layout(set = 0, binding = 4, scalar) buffer Counters { WetnessCounters counters; };

void store(ivec3 at, GBufferWords words);

struct Weight {
    float rain;  // share of the rain that arrives on the surface
    float up;    // cosine between normal and where rain comes from
};

void count(float visibility) {
    atomicAdd(counters.looked_up, 1u);
    if (visibility == 0.0) atomicAdd(counters.sheltered, 1u);
    if (visibility > 0.0 && visibility < 1.0) atomicAdd(counters.partly, 1u);
}

Weight weight_of(vec3 position, vec3 normal) {
    const float up = dot(normal, push.map.towards_rain);
    const float slope = clamp(10.0 * up + 5.5, 0.0, 1.0);
    const float fade = 1.0 - smoothstep(fade_begin, reach, position.z), known = fade * fade;
    float visibility = beyond == beyond_open ? 1.0 : 0.0;
    if (slope > 0.0 && known > 0.0) {
        visibility = rain_visibility(position, normal);
        count(visibility);
        visibility = mix(beyond == beyond_open ? 1.0 : 0.0, visibility, known);
    }
    return Weight(slope * visibility, up);
}

// How much of a pattern of this size a pixel shows: all where the pixel is no wider on the surface, nothing from twice that on.
float share_shown(vec3 position, vec3 normal, float size) {
    if (ripple_filter == 0u) return 1.0;
    const float cosine = max(abs(dot(normal, normalize(position))), 0.1);
    const float footprint = 2.0 * position.z / (view.ndc_scale.y * float(view.extent.y)) / cosine;
    return clamp(2.0 - footprint / size, 0.0, 1.0);
}

// In world space.
vec3 rippled(vec3 normal, vec3 position, vec3 place, Weight weight) {
    const float up = max(weight.up, 0.0);
    const vec3 in_world = view.to_world * normal;
    vec3 bent = vec3(0.0);
    if (ripple_height > 0.0 && up > 0.0 && push.intensity > 0.0) {
        const float shown = share_shown(position, normal, ring_width);
        if (shown > 0.0) bent.xz -= up * shown * ring_gradient(place);
    }
    if (flow_height > 0.0 && push.intensity > 0.0) {
        const float shown = push.intensity * share_shown(position, normal, 1.0 / flow_cells);
        const uint steps = flow_steps(up);
        if (shown > 0.0) {
            bent.z -= shown * abs(in_world.x) * stream_slope(flow_z_key, place.z, push.cubes.z, place.y, steps);
            bent.x -= shown * abs(in_world.z) * stream_slope(flow_x_key, place.x, push.cubes.x, place.y, steps);
        }
    }
    return bent * weight.rain;
}

// Porosity is what roughness says of it (Lagarde, Water drop 3b, 2013); metals have none.
float porosity(Surface s) { return clamp((s.roughness - 0.5) / 0.4, 0.0, 1.0) * (1.0 - s.metallic); }

void color(inout Surface s, float wet, float puddle) {
    float gloss = 1.0 - s.roughness;
    if (form == form_xray) {
        const float soaked = wet * 0.33 * (s.base_color.r + s.base_color.g + s.base_color.b);
        s.base_color *= max(0.5, 1.0 - sqrt(max(soaked, 0.0)));
        gloss = min(gloss + 0.8 * soaked, 1.0);
    } else {
        const float soaked = max(wet * porosity(s), puddle * (1.0 - s.metallic));
        s.base_color *= mix(1.0, wet_albedo, soaked);
        gloss = max(gloss, soaked * wet_gloss);
    }
    s.roughness = 1.0 - mix(gloss, max(gloss, puddle_gloss), puddle);
}

// The dry surface where no water is.
bool wetten(inout Surface s, vec3 position) {
    const vec3 normal = facing_normal(s.lighting_model, s.normal, position);
    const Weight weight = weight_of(position, normal);
    if (weight.rain <= 0.0) return false;
    const vec3 place = world_place(position), in_world = view.to_world * normal;
    const float level = max(in_world.y, 0.0);
    float puddle = 0.0;
    if (level > 0.0) puddle = weight.rain * level * level * level * level * puddle_at(place);
    color(s, weight.rain * push.wetness, puddle);
    if (s.lighting_model == model_hair) return true;
    const vec3 flat_normal = mix(in_world, vec3(0.0, 1.0, 0.0), puddle);
    s.normal = normalize((flat_normal + rippled(normal, position, place, weight)) * view.to_world);
    return true;
}

GBufferWords words_of(Surface s, uvec2 pixel) {
    if ((gbuffer_layout & layout_index_mask) != layout_decoded)
        return pack_gbuffer(gbuffer_layout & layout_index_mask, lit_point(s, pixel));
    const vec4 material = vec4(float(s.lighting_model), s.metallic, s.occlusion, place_code(s.offset));
    return GBufferWords(vec4(s.normal, s.z), vec4(s.base_color, s.roughness), material);
}

GBufferWords dry_words(ivec3 at) {
    return GBufferWords(texelFetch(gbuffer0, at, 0), texelFetch(gbuffer1, at, 0), texelFetch(gbuffer2, at, 0));
}

// In a plain pixel the first sample's surface stands for all.
void main() {
    const ivec3 at = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(at, ivec3(view.extent, view.samples))) || at.z > 0 && is_plain(at.xy)) return;
    Surface s = surface_at(at);
    const int end = is_plain(at.xy) ? int(view.samples) : at.z + 1;
    if (!takes_light(s) || !wetten(s, surface_position(s, uvec2(at.xy)))) {
        for (int i = at.z; i < end; ++i) store(ivec3(at.xy, i), dry_words(ivec3(at.xy, i)));
        return;
    }
    atomicAdd(counters.wet, 1u);
    const GBufferWords words = words_of(s, uvec2(at.xy));
    for (int i = at.z; i < end; ++i) store(ivec3(at.xy, i), words);
}
