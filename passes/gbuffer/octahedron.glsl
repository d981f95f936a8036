// Unit vectors unfolded onto the square -1..1 (Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors,
// 2014). The fold needs a sign that is never 0.
#ifndef PASSES_GBUFFER_OCTAHEDRON_GLSL
#define PASSES_GBUFFER_OCTAHEDRON_GLSL

vec2 to_octahedron(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0) p = (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0)));
    return p;
}

vec3 from_octahedron(vec2 p) {
    const float z = 1.0 - abs(p.x) - abs(p.y);
    const float fold = max(-z, 0.0);
    p -= mix(vec2(-fold), vec2(fold), greaterThanEqual(p, vec2(0.0)));
    return normalize(vec3(p, z));
}

#endif
