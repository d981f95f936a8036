// The light of a convex emitter of one radiance is that of its outline, whatever is inside: irradiance as the sum over the outline's
// edges (Lambert 1760; docs/algorithms/lighting.md 0.4), the part below the horizon cut away. Any shader stage.
#ifndef PASSES_SHADERS_POLYGON_LIGHT_GLSL
#define PASSES_SHADERS_POLYGON_LIGHT_GLSL

// Round outlines are polygons of 16 corners with the circle's area.
const uint circle_corners = 16u;
const float circle_cosine = 0.923879533, circle_sine = 0.382683432;  // of 2 pi / 16
const float circle_scale = 1.01300156;                              // sqrt(2 pi / (16 sin(2 pi / 16)))

// Corners are circle * (x, y, 1): around the origin, where the lit point is, counter-clockwise seen from there as x turns to y
// around the third column. Of two circles it is their convex hull: `tangents` are the x at which the sides between them touch the
// first and the second; corners beyond are the second's.
struct Outline {
    mat3 circle, second;
    vec2 tangents;  // above 1: there is no second
    uint corners;   // 4: a rectangle, its corners at (+-1, +-1); else circle_corners
    vec3 facing;    // unit; all of the emitter is on its side
};

// atan(y, x) / y for y >= 0, finite for y = 0. A polynomial of its own: GLSL's atan may be 4096 units in the last place off.
// Interpolates atan(t) / t in t^2 at Chebyshev nodes of 0..1; off by 1.2e-7.
float arc_over_sine(float y, float x) {
    const bool steep = y > abs(x);
    const float t = (steep ? abs(x) : y) / max(max(abs(x), y), 1e-30), u = t * t;
    const float p = 0.999999882 + u * (-0.333318127 + u * (0.199669618 + u * (-0.140032902 + u *
                    (0.098688655 + u * (-0.058829753 + u * (0.023780519 - u * 0.004559792))))));
    const float small_angle = t * p;
    if (steep) return (1.57079633 + (x < 0.0 ? small_angle : -small_angle)) / y;
    return x < 0.0 ? (3.14159265 - small_angle) / max(y, 1e-30) : p / max(x, 1e-30);
}

// Of the edge from p to p + along: angle times normal. The vector along the edge is at hand exactly, where the difference of two far
// corners would not be.
vec3 edge_flux(vec3 p, vec3 along) {
    const vec3 normal = cross(p, along);
    return normal * arc_over_sine(length(normal), dot(p, p + along));
}

struct Walk {
    vec3 sum;
    vec3 entry, leave;  // where the outline comes above the horizon and where it goes below
    bool cut;
};

// A corner on the horizon counts as below it.
void walk_edge(inout Walk walk, vec3 p, vec3 along) {
    const float from = p.z, to = p.z + along.z;
    if (from <= 0.0 && to <= 0.0) return;
    const float begin = from <= 0.0 ? from / (from - to) : 0.0;
    const float end = to <= 0.0 ? from / (from - to) : 1.0;
    if (from <= 0.0) walk.entry = vec3(p.xy + begin * along.xy, 0.0);
    if (to <= 0.0) walk.leave = vec3(p.xy + end * along.xy, 0.0);
    walk.cut = walk.cut || from <= 0.0 || to <= 0.0;
    walk.sum += edge_flux(p + begin * along, (end - begin) * along);
}

vec3 corner(mat3 circle, vec2 at) { return circle * vec3(at, 1.0); }

// Along the first circle to where the side touches it, along the side, and on along the second. The side touches the circle itself:
// the polygon with the circle's area is larger.
void walk_side(inout Walk walk, mat3 from, mat3 to, vec4 corners, vec2 tangents) {
    const float half_plane = corners.y + corners.w < 0.0 ? -1.0 : 1.0;
    const vec2 x = clamp(tangents, -1.0, 1.0), y = half_plane * sqrt(1.0 - x * x);
    const vec2 leaving = vec2(x.x, y.x) / circle_scale, arriving = vec2(x.y, y.y) / circle_scale;
    const vec3 touched = corner(from, leaving), reached = corner(to, arriving);
    walk_edge(walk, corner(from, corners.xy), from * vec3(leaving - corners.xy, 0.0));
    walk_edge(walk, touched, reached - touched);
    walk_edge(walk, reached, to * vec3(corners.zw - arriving, 0.0));
}

// The integral of the direction over the part of the outline's solid angle that is above z = 0 of the space `to` leads to. Its z is
// the irradiance of radiance 1 there, and its direction where that comes from.
vec3 outline_flux(Outline outline, mat3 to) {
    const mat3 circle = to * outline.circle, second = to * outline.second;
    const bool is_rectangle = outline.corners == 4u;
    const vec2 first = is_rectangle ? vec2(1.0) : vec2(1.0, 0.0);
    const vec2 turn = is_rectangle ? vec2(0.0, 1.0) : vec2(circle_cosine, circle_sine);
    const float split = 0.5 * (outline.tangents.x + outline.tangents.y);
    Walk walk = Walk(vec3(0.0), vec3(0.0), vec3(0.0), false);
    vec2 at = first;
    for (uint i = 1u; i <= outline.corners; ++i) {
        const vec2 next = i == outline.corners ? first : vec2(at.x * turn.x - at.y * turn.y, at.x * turn.y + at.y * turn.x);
        const bool from_second = at.x > split, to_second = next.x > split;
        if (from_second && !to_second) {
            walk_side(walk, second, circle, vec4(at, next), outline.tangents.yx);
        } else if (to_second && !from_second) {
            walk_side(walk, circle, second, vec4(at, next), outline.tangents);
        } else if (from_second) {
            walk_edge(walk, corner(second, at), second * vec3(next - at, 0.0));
        } else {
            walk_edge(walk, corner(circle, at), circle * vec3(next - at, 0.0));
        }
        at = next;
    }
    if (walk.cut) walk.sum += edge_flux(walk.leave, walk.entry - walk.leave);
    return 0.5 * walk.sum;
}

#endif
