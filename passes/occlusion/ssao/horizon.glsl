// Ambient visibility from horizons (Jimenez et al., Practical Realtime Strategies for Accurate Indirect Occlusion, SIGGRAPH 2016,
// 4): the hemisphere is cut into slices through the way to the eye; in each, taps along the slice's line in the picture find the
// highest occluder on either side, and the cosine-weighted arc between the two horizons is known in closed form.
//
// Slices are turned about the way to the eye and not about the view's axis, so that equal angles are equal shares of the
// hemisphere anywhere in the picture. Visibility is one less the ratio of what slices lose and what they have: few slices do not add up
// to one hemisphere, and an open plane is exactly 1.
#ifndef PASSES_OCCLUSION_SSAO_HORIZON_GLSL
#define PASSES_OCCLUSION_SSAO_HORIZON_GLSL
#include "passes/occlusion/ssao/estimate.glsl"

const float pi = 3.14159265358979;
const float half_pi = 1.57079632679490;

vec2 pixel_of(vec3 ray) {
    const vec2 ndc = view.ndc_scale * ray.xy / ray.z + view.ndc_offset;
    return (vec2(0.5) + vec2(0.5, -0.5) * ndc) * vec2(view.extent);
}

// Cut at the border of the picture.
vec2 inside_picture(vec2 from, vec2 way) {
    const vec2 beyond = mix(from, vec2(view.extent) - from, greaterThan(way, vec2(0.0))) - 1e-3;
    const vec2 share = beyond / max(abs(way), vec2(1e-6));
    return way * min(1.0, min(share.x, share.y));
}

// In pixels: from the sample to where the slice's ray that touches the sphere of the radius, on the side of `along`, is seen. Where
// the eye is in the sphere or the ray leads behind it, to the border.
vec2 reach_of(Center c, vec3 along) {
    const vec3 p = c.place.position;
    const float sine = push.radius / length(p);
    if (sine < 1.0) {
        const vec3 ray = sine * along - sqrt(1.0 - sine * sine) * c.to_eye;
        if (ray.z > 0.05) return inside_picture(c.pixel, pixel_of(ray) - c.pixel);
    }
    const vec2 turn = (along.xy - p.xy * (along.z / p.z)) * view.ndc_scale * vec2(view.extent) * vec2(0.5, -0.5);
    return inside_picture(c.pixel, normalize(turn) * float(view.extent.x + view.extent.y));
}

// How far a tap counts as being above the tangent plane: less than it is by what depth and normals may be wrong, so that a plane
// does not occlude itself.
float height_of(Place center, Place tap, vec3 way) {
    const float wrong = push.depth_error * (abs(dot(center.position, center.normal)) + abs(dot(tap.position, center.normal)));
    return dot(way, center.normal) - wrong - push.bias * length(way);
}

// Whether a tap's plane goes on to one farther away.
bool goes_on(Place near, Place far) {
    const vec3 way = far.position - near.position;
    return dot(near.normal, far.normal) > 0.9 && abs(dot(way, near.normal)) < 0.02 * length(way);
}

// Where the way from one place to another, relative to the sample, leaves the sphere of the radius: the first is inside, the second is not.
vec3 leaving_sphere(vec3 inside, vec3 outside) {
    const vec3 way = outside - inside;
    const float a = dot(way, way), b = dot(inside, way), c = dot(inside, inside) - push.radius * push.radius;
    return inside + way * ((sqrt(max(b * b - a * c, 0.0)) - b) / a);
}

// Cosine of the angle between the way to the eye and the highest occluder on a side of a slice; -2 where there is none. A plane that goes
// on beyond the radius occludes up to the radius, wherever on it the taps are.
float highest(Center c, vec3 along, inout Tally tally) {
    const vec2 way = reach_of(c, along);
    const float pixels = length(way);
    float cosine = -2.0;
    Place last = c.place;
    if (pixels < 1e-3) return cosine;
    for (uint i = 0u; i < steps; ++i) {
        const float part = (float(i) + c.noise.y) / float(steps);
        const ivec2 at = ivec2(floor(c.pixel + way * (max(part * pixels, float(i) + 1.0) / pixels)));
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(view.extent)))) continue;
        ++tally.taps;
        const Place tap = place_at(ivec3(at, c.sample_index));
        if (!tap.exists) continue;
        vec3 d = tap.position - c.place.position;
        if (dot(d, d) > push.radius * push.radius) {
            if (!goes_on(last, tap)) continue;
            d = leaving_sphere(last.position - c.place.position, d);
        } else {
            last = tap;
            ++tally.in_reach;
        }
        const float height = height_of(c.place, tap, d);
        if (height <= 0.0) continue;
        const vec3 lowered = d + c.place.normal * (height - dot(d, c.place.normal));
        const vec2 in_slice = vec2(dot(lowered, c.to_eye), dot(lowered, along));
        cosine = max(cosine, in_slice.x / max(length(in_slice), 1e-9));
    }
    return cosine;
}

// The cosine-weighted arc from the way to the eye to angle h, of a normal at angle n, but for what both share.
float arc(float h, float n) { return 0.25 * (2.0 * h * sin(n) - cos(2.0 * h - n)); }

// Of the arc that ends at angle `open` on a side where nothing occludes: what the highest occluder takes.
float lost(float cosine, float side, float open, float n) {
    if (cosine < -1.0) return 0.0;
    const float horizon = side * acos(clamp(cosine, -1.0, 1.0));
    return side * horizon < side * open ? arc(open, n) - arc(horizon, n) : 0.0;
}

float horizon_visibility(Center c, inout Tally tally) {
    const vec3 right = normalize(vec3(1.0, 0.0, 0.0) - c.to_eye.x * c.to_eye), up = cross(c.to_eye, right);
    float whole = 0.0, taken = 0.0;
    for (uint i = 0u; i < directions; ++i) {
        const float angle = pi * (float(i) + c.noise.x) / float(directions);
        const vec3 along = cos(angle) * right + sin(angle) * up;
        const vec3 projected = c.place.normal - dot(c.place.normal, cross(c.to_eye, along)) * cross(c.to_eye, along);
        const float weight = length(projected);
        if (weight < 1e-5) continue;
        const float n = clamp(atan(dot(projected, along), dot(projected, c.to_eye)), -half_pi, half_pi);
        whole += weight * (cos(n) + n * sin(n));
        taken += weight * lost(highest(c, along, tally), 1.0, n + half_pi, n);
        taken += weight * lost(highest(c, -along, tally), -1.0, n - half_pi, n);
    }
    return whole > 0.0 ? 1.0 - taken / whole : 1.0;
}

#endif
