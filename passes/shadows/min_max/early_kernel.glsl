// A lookup by the fixed kernel of passes/shaders/shadow_filter.glsl that asks bounds of the map first and compares texels only where
// those do not settle it (Dmitriev, Uralsky 2005; Lobanchikov, Gruen: Clear Sky, GDC 2009; Gruen, GPU Pro 2010;
// docs/algorithms/deferred.md 5.3 to 5.6). Include it after shadow_filter.glsl.
//
// The result has the bits of fixed_kernel. llvmpipe runs both sides of a branch: only a loop that begins at its end is spared, but
// for one turn.
#include "passes/shadows/bounds/query.glsl"
#include "passes/shadows/min_max/min_max.shared.h"

layout(constant_id = 66) const uint bounds_form = form_overlapping;

// The weight of the kernel's first texels along an axis.
uint weight_before(int taps, uint f) {
    if (taps <= 0) return 0u;
    return taps >= shadow_kernel ? 256u * uint(shadow_kernel - 1) : 256u * uint(taps) - f;
}

// Of the texels from `begin` on in a square of the map.
uint weight_in(KernelPlace k, ivec2 begin, int edge) {
    const ivec2 a = begin - k.first, b = a + edge;
    return (weight_before(b.x, k.f.x) - weight_before(a.x, k.f.x)) * (weight_before(b.y, k.f.y) - weight_before(a.y, k.f.y));
}

// The least depth that a texel is compared with where the receiver has no gradient.
float compared_depth(MapPoint p) { return max(p.depth, 0.0); }

// What the receiver's plane rises at most over the kernel, and over half a texel more against rounding.
float greatest_rise(MapPoint p) {
    const ivec2 first = kernel_place(p.u).first, last = first + (shadow_kernel - 1);
    const vec2 to_first = vec2(kept_on_face(p, first)) + 0.5 - p.u, to_last = vec2(kept_on_face(p, last)) + 0.5 - p.u;
    return max(dot(abs(p.rise), max(abs(to_first), abs(to_last)) + 0.5) - p.risen, 0.0);
}

uint class_of(MapPoint p, vec2 extremes, float depth) {
    const uint found = bounds_class(extremes, depth);
    return found == class_shadowed && depth + greatest_rise(p) >= extremes.x ? class_expensive : found;
}

// --- hierarchical -----------------------------------------------------------------------------------------------------------

const int coarsest_level = bounds_block == 2 ? 1 : bounds_block == 4 ? 2 : 3;

// Beyond the map depth is 0.
uint class_of_node(MapPoint p, int level, ivec2 node) {
    const ivec2 begin = node << level;
    vec2 extremes = vec2(0.0);
    if (all(greaterThanEqual(node, ivec2(0))) && all(lessThan(begin, ivec2(p.size))))
        extremes = extremes_of_node(p.corner, level, node);
    return class_of(p, extremes, compared_depth(p));
}

bool compares_texels = false;  // this lookup

// GLSL has no recursion: a node of a level asks its children by the function of the level below, one of 2 x 2 texels its texels.
uint lit_in_node_1(MapPoint p, KernelPlace k, ivec2 node) {
    const uint weight = weight_in(k, 2 * node, 2);
    if (weight == 0u) return 0u;
    const uint found = class_of_node(p, 1, node);
    uint sum = found == class_lit ? weight : 0u;
    for (int i = found == class_expensive ? 0 : 4; i < 4; ++i) {
        const ivec2 texel = 2 * node + ivec2(i & 1, i >> 1);
        sum += weight_in(k, texel, 1) * is_lit(p, texel);
        compares_texels = true;
    }
    return sum;
}

uint lit_in_node_2(MapPoint p, KernelPlace k, ivec2 node) {
    const uint weight = weight_in(k, 4 * node, 4);
    if (weight == 0u) return 0u;
    const uint found = class_of_node(p, 2, node);
    uint sum = found == class_lit ? weight : 0u;
    for (int i = found == class_expensive ? 0 : 4; i < 4; ++i) sum += lit_in_node_1(p, k, 2 * node + ivec2(i & 1, i >> 1));
    return sum;
}

uint lit_in_node_3(MapPoint p, KernelPlace k, ivec2 node) {
    const uint weight = weight_in(k, 8 * node, 8);
    if (weight == 0u) return 0u;
    const uint found = class_of_node(p, 3, node);
    uint sum = found == class_lit ? weight : 0u;
    for (int i = found == class_expensive ? 0 : 4; i < 4; ++i) sum += lit_in_node_2(p, k, 2 * node + ivec2(i & 1, i >> 1));
    return sum;
}

uint lit_in_coarsest(MapPoint p, KernelPlace k, ivec2 node) {
    if (coarsest_level == 1) return lit_in_node_1(p, k, node);
    return coarsest_level == 2 ? lit_in_node_2(p, k, node) : lit_in_node_3(p, k, node);
}

float hierarchical_share(MapPoint p, out uint found) {
    const KernelPlace k = kernel_place(p.u);
    const ivec2 first = k.first >> coarsest_level, last = (k.first + (shadow_kernel - 1)) >> coarsest_level;
    uint sum = 0u;
    compares_texels = false;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) sum += lit_in_coarsest(p, k, ivec2(x, y));
    found = class_expensive;
    if (!compares_texels && (sum == kernel_total || sum == 0u)) found = sum == 0u ? class_shadowed : class_lit;
    return share_of_weight(sum);
}

// --- one texel of bounds, or all that the kernel touches --------------------------------------------------------------------

// Of blocks without a reach. Beyond the map depth is 0; beyond a face its outermost texels go on.
vec2 extremes_between(MapPoint p, ivec2 first, ivec2 last) {
    if (!has_bounds(p.size)) return unbounded;
    const ivec2 end = ivec2(p.size - 1), a = clamp(first, ivec2(0), end), b = clamp(last, ivec2(0), end);
    const bool leaves = any(notEqual(a, first)) || any(notEqual(b, last));
    vec2 found = vec2(!p.at_seams && leaves ? 0.0 : 1.0, 0.0);
    for (int y = a.y / bounds_block; y <= b.y / bounds_block; ++y) {
        for (int x = a.x / bounds_block; x <= b.x / bounds_block; ++x) {
            const vec2 extremes = bounds_texel(p.corner, ivec2(x, y)).xy;
            found = vec2(min(found.x, extremes.x), max(found.y, extremes.y));
        }
    }
    return found;
}

// The receiver follows the plane of the block, if its window is one: then the comparisons do, too.
uint class_by_plane(inout MapPoint p) {
    if (!has_bounds(p.size)) return class_expensive;
    const ivec2 block = block_of(p.size, p.u);
    const vec4 plane = bounds_texel(p.corner, block);
    p.gradient = plane.zw;
    if (p.gradient != vec2(0.0)) p.rise = vec2(0.0);
    return class_of(p, plane.xy, max(p.depth + dot(p.gradient, window_center(block) - p.u), 0.0));
}

uint class_by_bounds(inout MapPoint p) {
    if (bounds_form == form_plane) return class_by_plane(p);
    const ivec2 first = kernel_place(p.u).first, last = first + (shadow_kernel - 1);
    vec2 bounds;
    if (bounds_form == form_block) bounds = extremes_between(p, first, last);
    else if (bounds_form == form_overlapping) bounds = extremes_at(p.corner, p.size, p.u);
    else bounds = slab_at(p.corner, p.size, p.u, first, last);
    return class_of(p, bounds, compared_depth(p));
}

// --- the lookup -------------------------------------------------------------------------------------------------------------

// Depth of the texels (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1), each as map_depth reads it after kept_on_face. Quads are
// gathered at the corner that they share: half a texel from where a device's rounding would choose another one (5.2). Beyond the
// map's edge the quad is the outermost one, of which the outermost row or column is taken twice.
vec4 quad_depths(MapPoint p, ivec2 texel) {
    const ivec2 last = ivec2(p.size - 1), quad = clamp(texel, ivec2(0), max(last - 1, ivec2(0)));
    const vec2 corner = vec2(p.corner.xy + quad + 1) / vec2(textureSize(shadow_maps, 0).xy);
    const vec4 found = textureGather(shadow_maps, vec3(corner, float(p.corner.z))).wzxy;
    const bvec2 second_of_first = greaterThan(clamp(texel, ivec2(0), last), quad);
    const bvec2 second_of_second = greaterThan(clamp(texel + 1, ivec2(0), last), quad);
    const vec2 left = second_of_first.x ? found.yw : found.xz, right = second_of_second.x ? found.yw : found.xz;
    vec4 depth = vec4(second_of_first.y ? left.y : left.x, second_of_first.y ? right.y : right.x,
                      second_of_second.y ? left.y : left.x, second_of_second.y ? right.y : right.x);
    if (p.at_seams) return depth;
    const bvec2 in_first = equal(clamp(texel, ivec2(0), last), texel);
    const bvec2 in_second = equal(clamp(texel + 1, ivec2(0), last), texel + 1);
    return depth * vec4(in_first.x && in_first.y, in_second.x && in_first.y, in_first.x && in_second.y, in_second.x && in_second.y);
}

uvec4 are_lit(MapPoint p, ivec2 texel) {
    const vec4 receiver =
        vec4(plane_depth(p, kept_on_face(p, texel)), plane_depth(p, kept_on_face(p, texel + ivec2(1, 0))),
             plane_depth(p, kept_on_face(p, texel + ivec2(0, 1))), plane_depth(p, kept_on_face(p, texel + 1)));
    return uvec4(greaterThanEqual(receiver, quad_depths(p, texel)));
}

// As fixed_kernel, by (N / 2)^2 gathers, beginning with the row `y`.
float gathered_kernel_from(int y, MapPoint p) {
    const KernelPlace k = kernel_place(p.u);
    uint sum = 0u;
    for (; y < shadow_kernel; y += 2) {
        uvec2 in_rows = uvec2(0u);
        for (int x = 0; x < shadow_kernel; x += 2) {
            const uvec4 lit = are_lit(p, k.first + ivec2(x, y));
            in_rows += kernel_weight(x, k.f.x) * lit.xz + kernel_weight(x + 1, k.f.x) * lit.yw;
        }
        sum += kernel_weight(y, k.f.y) * in_rows.x + kernel_weight(y + 1, k.f.y) * in_rows.y;
    }
    return share_of_weight(sum);
}

// `found` is its class. The gradient of p becomes the one that the comparisons follow.
float early_share(inout MapPoint p, out uint found) {
    const ivec2 first = kernel_place(p.u).first, end = first + shadow_kernel;
    const bool is_inside = all(greaterThanEqual(first, ivec2(0))) && all(lessThanEqual(end, ivec2(p.size)));
    // The hierarchy's nodes know nothing of the texels that go on beyond a face.
    if (bounds_form == form_hierarchical && has_bounds(p.size) && (is_inside || !p.at_seams)) return hierarchical_share(p, found);
    found = class_expensive;
    if (bounds_form != form_hierarchical) found = class_by_bounds(p);
    const float compared = gathered_kernel_from(found == class_expensive ? 0 : shadow_kernel, p);
    return found == class_lit ? 1.0 : compared;
}
