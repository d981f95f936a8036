// Sun shafts by marching the ray of every sample through the sun's shadow maps (docs/algorithms/deferred.md 6). Whoever includes
// this defines is_decided(), which may answer a step without the map, and are_decided(), which may answer a segment of steps.
#ifndef PASSES_SUN_SHAFTS_MARCH_GLSL
#define PASSES_SUN_SHAFTS_MARCH_GLSL
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "passes/edges/plain_pixels.glsl"
#include "passes/shaders/hash.shared.h"
#include "passes/sun_shafts/ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 2) const uint steps = 32u;
layout(constant_id = 3) const uint taps = taps_4;
layout(constant_id = 4) const uint stepping = stepping_stratified;
layout(constant_id = 5) const uint jitter = jitter_interleaved;
layout(constant_id = 6) const uint extinction = extinction_integrated;
layout(constant_id = 7) const uint cascade = cascade_of_step;
layout(constant_id = 8) const uint divisor = 1u;   // pixels a side for which one ray is marched
layout(constant_id = 9) const uint has_maps = 0u;  // 0: the sun casts no shadow
layout(constant_id = 10) const uint allocation = 0u;  // Allocation of passes/scene/shadow_views.h
layout(constant_id = 11) const uint shows_decided = 0u;  // 1: the share of steps answered without the map is stored instead
layout(constant_id = 12) const uint segment = 1u;        // steps that are_decided() is asked about at once; 1: it is not asked
layout(constant_id = 14) const uint keeps_share = 0u;    // 1: the lit share is stored, which later steps make radiance of

layout(set = 0, binding = 0) uniform sampler2DArray shadow_maps;
layout(set = 0, binding = 1, rgba16f) writeonly uniform image2DArray shafts;
layout(set = 0, binding = 3, scalar) buffer Counters { MarchCounters counters; };

// How a ray lies in one map: the eye, and what a meter adds. Texels in x and y, depth in z.
struct MapRay {
    ivec3 corner;  // the map's first texel, its layer
    int size;
    vec3 eye, per_meter;
};

struct Tally {
    uint fetches, bounds, skipped, in_segments;  // the last two: steps decided each alone, and by their segment
};

// Whether something cheaper than the map says how much of the sun reaches a place of it: exactly what lit_share() would.
bool is_decided(MapRay map, vec3 at, inout Tally tally, out float lit);
// The same of all steps of a segment, whose places lie between those of the first and of the last.
bool are_decided(MapRay map, vec3 first, vec3 last, inout Tally tally, out float lit);

uint bayer_2(uvec2 bits) { return 2u * (bits.x ^ bits.y) + bits.y; }

// Where the first step lies in its stratum, 0 to 1. In integers, so that all devices draw the same numbers: the gradient is that
// of Jimenez 2014, fract(52.9829189 fract(.06711056 x + .00583715 y)), in units of 2^-32. The interleaved pattern is Bayer's 4 x 4 matrix:
// a blur over 4 x 4 texels has 16 times as many steps.
float jitter_at(uvec2 texel) {
    if (jitter == jitter_none) return stepping == stepping_xray ? 0.0 : 0.5;
    if (jitter == jitter_interleaved) return (float(4u * bayer_2(texel & 1u) + bayer_2(texel >> 1u & 1u)) + 0.5) / 16.0;
    uint drawn;
    if (jitter == jitter_hash) {
        drawn = hashed(view.seed, uvec3(texel, view.frame_index));
    } else {
        const uint inner = texel.x * 288237660u + texel.y * 25070368u;
        uint high, low;
        umulExtended(inner, 4221604530u, high, low);
        drawn = 52u * inner + high;
    }
    return (float(drawn >> 16u) + 0.5) / 65536.0;
}

// The receiver moves towards the sun by the map's bias.
MapRay map_ray(uint record, vec3 direction) {
    const ShadowRecord map = shadows[record];
    const vec3 units = vec3(map.size, map.size, 1.0);
    precise const vec3 eye = units * (map.view_to_map * vec4(-map.bias * lights[0].direction, 1.0)).xyz;
    precise const vec3 per_meter = units * (map.view_to_map * vec4(direction, 0.0)).xyz;
    return MapRay(ivec3(map.offset, map.layer), int(map.size), eye, per_meter);
}

// Outside the map, depth is that of nothing drawn: lit.
uint is_lit(MapRay map, ivec2 texel, float depth, inout Tally tally) {
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(map.size)))) return 1u;
    ++tally.fetches;
    return max(depth, 0.0) >= texelFetch(shadow_maps, map.corner + ivec3(texel, 0), 0).r ? 1u : 0u;
}

// One texel, or four with bilinear weights in integers of 1/256, so that all lit is exactly 1.
float lit_share(MapRay map, vec3 at, inout Tally tally) {
    if (taps == taps_1) return float(is_lit(map, ivec2(floor(at.xy)), at.z, tally));
    precise const vec2 place = at.xy - 0.5;
    const ivec2 low = ivec2(floor(place));
    const uvec2 f = min(uvec2(256.0 * (place - floor(place))), uvec2(255u));
    const uint upper =
        (256u - f.x) * is_lit(map, low, at.z, tally) + f.x * is_lit(map, low + ivec2(1, 0), at.z, tally);
    const uint lower =
        (256u - f.x) * is_lit(map, low + ivec2(0, 1), at.z, tally) + f.x * is_lit(map, low + ivec2(1, 1), at.z, tally);
    return float((256u - f.y) * upper + f.y * lower) / 65536.0;
}

// The first cascade that reaches a view depth; beyond them the last.
uint record_at(float z) {
    const uint first = lights[0].shadow + allocation * view.shadow_count, last = first + lights[0].shadow_slots - 1u;
    if (cascade == cascade_last) return last;
    uint record = first;
    while (record < last && z >= shadows[record].range_end) ++record;
    return record;
}

// Meters from the eye to a step's place: one in every stratum, or X-Ray's from the surface to near the eye.
float place_of(uint k, float meters, float drawn) {
    const float n = float(steps);
    precise float share = (float(k) + drawn) / n;
    if (stepping == stepping_xray) share = 1.0 - float(k) * (n - drawn) / (n * n);
    return meters * share;
}

// What reaches the eye of what is scattered in a step's stratum, relative to its like at the eye.
float remains(uint k, float meters, float place) {
    if (normalization == normalization_steps) return 1.0;
    if (extinction == extinction_sampled) return exp(-view.fog_density * place);
    const uint stratum = stepping == stepping_xray ? steps - 1u - k : k;
    precise const float begin = meters * (float(stratum) / float(steps));
    return exp(-view.fog_density * begin);
}

// Of all steps' sum, so that 1 is lit throughout; with extinction=sampled but for the error of that.
float step_share(float meters) {
    if (normalization == normalization_steps) return 1.0 / float(steps);
    precise const float depth = view.fog_density * meters, in_step = depth / float(steps);
    return (extinction == extinction_sampled ? in_step : lost(in_step)) / lost(depth);
}

// Maps begin at the near plane: what lies before it is lit as the place on it.
float covered_place(float place, ShaftRay ray) { return max(place, view.near / ray.direction.z); }

vec3 place_on(MapRay map, float covered) {
    precise const vec3 at = map.eye + map.per_meter * covered;
    return at;
}

// Where the last step of the segment that begins with step k is covered.
float end_of_segment(uint k, ShaftRay ray, float drawn) {
    return covered_place(place_of(min(k + segment, steps) - 1u, ray.meters, drawn), ray);
}

// The share of the light scattered along the ray that the sun's shadows leave.
float lit_share_of(ShaftRay ray, uvec2 texel, inout Tally tally) {
    const float drawn = jitter_at(texel);
    uint record = no_index;
    MapRay map;
    bool is_known = false;  // what the steps of the segment have in common
    float known = 1.0;
    precise float sum = 0.0;
    for (uint k = 0u; k < steps; ++k) {
        precise const float place = place_of(k, ray.meters, drawn);
        float lit = known;
        if (has_maps != 0u && !(is_known && k % segment != 0u)) {
            precise const float covered = covered_place(place, ray);
            const uint wanted = record_at(covered * ray.direction.z);
            if (wanted != record) map = map_ray(wanted, ray.direction);
            record = wanted;
            const vec3 at = place_on(map, covered);
            is_known = false;
            if (segment > 1u && k % segment == 0u) {
                const float end = end_of_segment(k, ray, drawn);
                is_known = record_at(end * ray.direction.z) == record && are_decided(map, at, place_on(map, end), tally, known);
                if (is_known) tally.in_segments += min(segment, steps - k);
            }
            if (is_known) lit = known;
            else if (!is_decided(map, at, tally, lit)) lit = lit_share(map, at, tally);
        }
        sum += remains(k, ray.meters, place) * lit;
    }
    return sum * step_share(ray.meters);
}

// Adds to a count kept as 1024s and the rest: what the rest passes on.
uint carried(uint before, uint more) { return ((before & 1023u) + more) / 1024u; }

void count(Tally tally) {
    const uint rays = subgroupAdd(1u);
    const uvec4 all = subgroupAdd(uvec4(tally.fetches, tally.bounds, tally.skipped, tally.in_segments));
    if (!subgroupElect()) return;
    atomicAdd(counters.rays, rays);
    atomicAdd(counters.kilosteps, carried(atomicAdd(counters.steps, rays * steps), rays * steps));
    atomicAdd(counters.kilofetches, carried(atomicAdd(counters.fetches, all.x), all.x));
    atomicAdd(counters.kilobounds, carried(atomicAdd(counters.bounds, all.y), all.y));
    atomicAdd(counters.kiloskipped, carried(atomicAdd(counters.skipped, all.z + all.w), all.z + all.w));
    atomicAdd(counters.kilosteps_in_segments, carried(atomicAdd(counters.in_segments, all.w), all.w));
}

// Radiance, or the share alone, which blur.comp or upsample.comp makes radiance of.
void main() {
    const ivec3 texel = ivec3(gl_GlobalInvocationID), at = ivec3(texel.xy * int(divisor), texel.z);
    if (any(greaterThanEqual(texel, imageSize(shafts))) || at.z > 0 && is_plain(at.xy)) return;
    const ShaftRay ray = ray_to(at);
    Tally tally = Tally(0u, 0u, 0u, 0u);
    const float share = lit_share_of(ray, uvec2(texel.xy), tally);
    count(tally);
    vec3 result = keeps_share != 0u ? vec3(share) : share * scattered(ray.meters) * push.radiance * phase_factor(ray.direction);
    if (shows_decided != 0u) result = vec3(float(tally.skipped + tally.in_segments) / float(steps));
    imageStore(shafts, texel, vec4(result, 1.0));
    if (!is_plain(at.xy)) return;
    for (int i = 1; i < imageSize(shafts).z; ++i) imageStore(shafts, ivec3(texel.xy, i), vec4(result, 1.0));
}

#endif
