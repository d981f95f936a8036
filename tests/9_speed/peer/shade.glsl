// Light of sky and ground on a diffuse surface that has two sides: premultiplied radiance and alpha.
layout(location = 0) in vec3 normal;
layout(location = 1) in vec4 color;

vec4 shade() {
    const vec3 outward = normalize(gl_FrontFacing ? normal : -normal);
    return vec4(color.rgb * mix(ground, sky, 0.5 + 0.5 * dot(outward, up)) * color.a, color.a);
}
