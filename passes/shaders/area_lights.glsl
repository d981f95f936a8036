// Tubes, spheres, discs and rectangles of one radiance: their outlines, and what of their light is reflected. Diffuse light by
// Lambert's polygon formula, GGX by linearly transformed cosines; what Burley adds to Lambert, and all of cloth, skin and hair, as if
// the light came from the emitter's mean direction.
#ifndef PASSES_SHADERS_AREA_LIGHTS_GLSL
#define PASSES_SHADERS_AREA_LIGHTS_GLSL
#include "passes/shaders/brdf.glsl"
#include "passes/shaders/light_types.glsl"
#include "passes/shaders/ltc.glsl"
#include "passes/shaders/polygon_light.glsl"
#include "passes/shaders/projected_texture.glsl"

// A point inside an emitter sees it as wide as this: nearly all of the half space.
const float widest_sine_squared = 0.9999;

// A unit vector perpendicular to a and b; to a alone where they are parallel.
vec3 across(vec3 a, vec3 b) {
    const vec3 normal = cross(a, b);
    const vec3 other = abs(a.x) < 0.5 ? vec3(0.0, -a.z, a.y) : vec3(-a.y, a.x, 0.0);  // x cross a, z cross a
    return dot(normal, normal) > 1e-8 ? normalize(normal) : normalize(other);
}

// The direction of something; of the point itself, the normal.
vec3 direction_to(vec3 offset, vec3 normal) {
    const float d = length(offset);
    return d > 1e-6 ? offset / d : normal;
}

// Tangent of the angle at which a sphere's rim is seen off its center.
float rim_tangent(float radius, float d) {
    const float sine_squared = min(radius * radius / max(d * d, 1e-12), widest_sine_squared);
    return sqrt(sine_squared / (1.0 - sine_squared));
}

// Turned so that one axis of symmetry is the plane of normal and axis.
mat3 circle_around(vec3 axis, vec3 normal, float radius) {
    const vec3 side = across(axis, normal);
    return mat3(cross(side, axis) * radius, side * radius, axis);
}

Outline whole_circle(mat3 circle, vec3 facing) { return Outline(circle, circle, vec2(2.0), circle_corners, facing); }

Outline sphere_outline(LightRecord light, vec3 offset, vec3 normal) {
    const vec3 axis = direction_to(offset, normal);
    return whole_circle(circle_around(axis, normal, circle_scale * rim_tangent(light.source_radius, length(offset))), axis);
}

Outline disc_outline(LightRecord light, vec3 offset, vec3 normal) {
    mat3 circle = circle_around(-light.direction, normal, circle_scale * light.source_radius);
    circle[2] = offset;
    return whole_circle(circle, -light.direction);
}

Outline rectangle_outline(LightRecord light, vec3 offset) {
    const mat3 sides = mat3(light.axis_u * light.half_extent.x, axis_v(light) * -light.half_extent.y, offset);
    return Outline(sides, sides, vec2(2.0), 4u, -light.direction);
}

// A capsule is seen as the convex hull of its end spheres, two circles of directions. The plane that touches the first at (x, y)
// has all of the second behind it where cos s0 sin w x - sin s0 cos w <= -sin s1, with w the angle between the ends and s their
// radii: equality is where the side begins. The same for the second, from the other end.
Outline tube_outline(LightRecord light, vec3 offset, vec3 normal) {
    const vec3 half_axis = light.axis_u * light.half_extent.x;
    const vec3 ends[2] = vec3[2](offset - half_axis, offset + half_axis);
    const vec3 axes[2] = vec3[2](direction_to(ends[0], normal), direction_to(ends[1], normal));
    const vec3 crossed = cross(axes[0], axes[1]);
    const float sine = length(crossed), cosine = dot(axes[0], axes[1]);
    const vec3 side = sine > 1e-5 ? crossed / sine : across(axes[0], normal);
    const vec2 t = vec2(rim_tangent(light.source_radius, length(ends[0])), rim_tangent(light.source_radius, length(ends[1])));
    const vec2 c = inversesqrt(1.0 + t * t), s = c * t;
    Outline outline;
    outline.circle = mat3(cross(side, axes[0]) * (circle_scale * t.x), side * (circle_scale * t.x), axes[0]);
    outline.second = mat3(cross(side, axes[1]) * (circle_scale * t.y), side * (circle_scale * t.y), axes[1]);
    outline.tangents = clamp(vec2(s.x * cosine - s.y, s.x - s.y * cosine) / max(c * sine, 1e-7), -2.0, 2.0);
    outline.corners = circle_corners;
    const float nearest = clamp(-dot(offset, light.axis_u), -light.half_extent.x, light.half_extent.x);
    outline.facing = direction_to(offset + light.axis_u * nearest, normal);
    return outline;
}

Outline outline_of(LightRecord light, vec3 offset, vec3 normal, uint features) {
    if (is_asked(features, feature_tube) && light.type == light_tube) return tube_outline(light, offset, normal);
    if (light.type == light_sphere) return sphere_outline(light, offset, normal);
    if (light.type == light_disc) return disc_outline(light, offset, normal);
    return rectangle_outline(light, offset);
}

// Rows: a unit vector in the plane of `up` and `towards`, one perpendicular to both, and `up`.
mat3 to_frame(vec3 up, vec3 towards) {
    const vec3 side = across(up, towards);
    return transpose(mat3(cross(side, up), side, up));
}

vec3 emitted(LightRecord light, vec3 offset, LightLobe lobe, uint features) {
    if (!is_asked(features, feature_projected_texture) || light.texture == no_index || light.type != light_rectangle)
        return light.intensity;
    return light.intensity * emitted_picture(light, offset, lobe);
}

// As a light in the emitter's mean direction, and a lobe as much wider as the emitter is seen wide: alpha + sin / 3 (after Karis
// 2013, whose R / (3 d) this is). For models whose lobe is no GGX, or whose light comes from behind, too.
vec3 reflected_as_one_direction(MaterialPoint m, LightRecord light, Outline outline, uint features) {
    const mat3 to_facing = to_frame(outline.facing, m.normal);
    const vec3 flux = transpose(to_facing) * outline_flux(outline, to_facing);
    const float irradiance = length(flux);
    if (irradiance < 1e-20) return vec3(0.0);
    const vec3 l = flux / irradiance;
    const float sine = sqrt(min(irradiance / pi, 1.0));
    m.roughness = sqrt(clamp(m.roughness * m.roughness + sine / 3.0, 0.0, 1.0));
    const vec3 radiance = emitted(light, light.position - m.position, LightLobe(l, 1.0), features);
    return brdf(m, l, normalize(-m.position), features) * brdf_cosine(m, l, features) * irradiance * radiance;
}

// Burley's departure from Lambert, as for a light in the emitter's mean direction.
float diffuse_shape(MaterialPoint m, vec3 l, vec3 v) {
    if (m.lighting_model != model_burley && m.lighting_model != model_plain_burley) return 1.0;
    return burley_shape(m, Directions(m.normal, l, v, normalize(l + v)));
}

struct Layers {
    vec3 highlight;
    vec3 share_left;  // for the diffuse layer
};

Layers ggx_layers(MaterialPoint m, LightRecord light, Outline outline, uint features) {
    const vec3 v = normalize(-m.position);
    const mat3 to_normal = to_frame(m.normal, v);
    const LtcRecord lobe = ltc_at(m.roughness, max(dot(m.normal, v), smallest_cosine));
    const float share = max(outline_flux(outline, ltc_inverse(lobe) * to_normal).z, 0.0) / pi;
    const vec3 f0 = mix(vec3(0.04), m.base_color, m.metallic);
    const vec3 sky = ltc_reflectance(lobe, m, f0);
    const vec3 left = m.lighting_model == model_multiscatter_ggx ? 1.0 - sky : vec3(1.0);
    const LightLobe from = LightLobe(transpose(to_normal) * ltc_axis(lobe), ltc_half_width(lobe));
    return Layers(sky * share * emitted(light, light.position - m.position, from, features), left);
}

// What is all below the horizon lights nothing, though a bent lobe may reach down there.
vec3 reflected_by_outline(MaterialPoint m, LightRecord light, Outline outline, uint features) {
    const mat3 to_normal = to_frame(m.normal, -m.position);
    const vec3 flux = outline_flux(outline, to_normal);
    if (flux.z <= 0.0) return vec3(0.0);
    const LightLobe from = LightLobe(normalize(transpose(to_normal) * flux), 1.0);
    const vec3 lambert = m.base_color * (flux.z / pi) * emitted(light, light.position - m.position, from, features);
    if (m.lighting_model == model_lambert) return lambert;
    const Layers layers = ggx_layers(m, light, outline, features);
    return lambert * layers.share_left * ((1.0 - m.metallic) * diffuse_shape(m, from.axis, normalize(-m.position))) + layers.highlight;
}

// Discs and rectangles shine to their front only. The window is that of the distance from the light's center.
vec3 reflected_area(MaterialPoint m, LightRecord light, uint features) {
    const vec3 offset = light.position - m.position;
    const float window = range_window(light, length(offset));
    const bool one_sided = light_is_flat(light.type);
    if (window <= 0.0 || m.lighting_model == model_unlit || (one_sided && dot(offset, light.direction) >= 0.0)) return vec3(0.0);
    const Outline outline = outline_of(light, offset, m.normal, features);
    // Those that have metals have a GGX lobe.
    if (m.lighting_model != model_lambert && !has_metals(m.lighting_model))
        return window * reflected_as_one_direction(m, light, outline, features);
    return window * reflected_by_outline(m, light, outline, features);
}

#endif
