// Every texel of a light's reflective shadow maps becomes a virtual point light: a lobe in the cell before its surface, in fixed
// point, so that the order of the sums does not matter (docs/algorithms/lighting.md 5.2 and 5.3).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/indirect/lpv/injection/receiving_cell.glsl"
#include "passes/shaders/finished.glsl"
#include "passes/shaders/lights.glsl"

layout(local_size_x = injecting_group) in;

layout(push_constant, scalar) uniform Push { InjectPush push; };
layout(constant_id = 22) const uint light_features = every_light_feature;

layout(set = 0, binding = 0) uniform sampler2DArray position;
layout(set = 0, binding = 1) uniform sampler2DArray normal;
layout(set = 0, binding = 2) uniform sampler2DArray albedo;

// W/sr of a light of some size, from its middle.
vec3 size_share(LightRecord light, vec3 towards) {
    const float facing = max(0.0, dot(towards, light.direction)), r = light.source_radius;
    if (light.type == light_sphere) return light.intensity * (pi * r * r);
    if (light.type == light_disc) return light.intensity * (pi * r * r * facing);
    if (light.type == light_rectangle) return light.intensity * (4.0 * light.half_extent.x * light.half_extent.y * facing);
    const float along = dot(towards, light.axis_u);
    return light.intensity * (4.0 * r * light.half_extent.x * sqrt(max(0.0, 1.0 - along * along)) + pi * r * r);
}

// W/sr towards a place, the range's window in it.
vec3 sent_towards(LightRecord light, vec3 place) {
    const vec3 offset = place - light.position;
    const float squared = dot(offset, offset);
    if (light_has_area(light.type)) return size_share(light, normalize(offset)) * range_window(light, sqrt(squared));
    MaterialPoint m;
    m.position = place;
    return incident_light(light, m, light_features & ~feature_projected_texture).irradiance * max(squared, nearest_light * nearest_light);
}

// W that arrive at a texel's surface.
vec3 arriving(LightRecord light, vec3 place, uvec2 texel) {
    if (!light_has_range(light.type)) return light.intensity * push.texel_area;
    const vec2 size = vec2(textureSize(position, 0).xy);
    const vec2 t = ((vec2(texel) + 0.5) / size * 2.0 - 1.0) * push.slopes;
    const float along = 1.0 + dot(t, t);
    const float solid_angle = 4.0 * push.slopes.x * push.slopes.y / (size.x * size.y) / (along * sqrt(along));
    return sent_towards(light, place) * solid_angle;
}

void inject(vec3 surface, vec3 n, vec3 flux) {
    const ivec3 cell = receiving_cell(push.grid, surface, n, push.bias);
    if (cell.x < 0) return;
    atomicAdd(counters.injected, 1u);
    add_lobe(cell_index(push.grid, cell), flux, n, push.fixed_one);
}

// A place that a light reaches is on its side of its blockers by the rule of ways, too: else cells behind a blocker would take light.
bool arrives(LightRecord light, vec3 place, vec3 n) {
    if (!blockers_pass(light, place + n * least_surface_offset, low_bits(light.blockers), low_bits(light.portals))) return false;
    return guards == 0u || !is_behind_blocker(light, way_start(LitPlace(view.to_world * place, view.to_world * n)));
}

// W of a texel's surface; nothing where it is not finite.
vec3 reflected_flux(LightRecord light, vec3 place, vec3 n, ivec3 at) {
    const vec3 flux = max(texelFetch(albedo, at, 0).rgb * arriving(light, place, uvec2(at.xy)), 0.0);
    const bool is_finite = dot(n, n) > 0.5 && all(lessThan(abs(place), vec3(1e18))) && all(lessThan(flux, vec3(1e30)));
    if (!is_finite || flux == vec3(0.0) || is_clipped(light, place)) return vec3(0.0);
    return arrives(light, place, n) ? flux : vec3(0.0);
}

void inject_texel(ivec3 at) {
    const vec4 place = texelFetch(position, at, 0);
    if (place.w == 0.0) return;
    const LightRecord light = lights[push.light];
    const vec3 to_light = light_has_range(light.type) ? light.position - place.xyz : -light.direction;
    const vec3 facing = texelFetch(normal, at, 0).xyz;
    const vec3 n = normalize(dot(facing, to_light) < 0.0 ? -facing : facing);
    // Most surfaces of a lamp beside the grid: nothing needs their light.
    if (!has_cell_before_it(push.grid, view.to_world * place.xyz, view.to_world * n, push.bias)) {
        atomicAdd(counters.outside, 1u);
        return;
    }
    const vec3 flux = reflected_flux(light, place.xyz, n, at);
    if (flux != vec3(0.0)) inject(view.to_world * place.xyz, view.to_world * n, flux);
}

void main() {
    const ivec3 size = textureSize(position, 0);
    const int i = int(gl_GlobalInvocationID.x), map = size.x * size.y;
    if (i < map * size.z) inject_texel(ivec3(i % size.x, i % map / size.x, i / map));
    if (!finished(view.extent.x)) atomicAdd(counters.unfinished, 1u);
}
