// The vertices of a draw. Each attribute lies in a buffer of its own, so that a mesh holds only those it has and no buffer is larger
// than a device binds. A particle is a quad of four vertices, which are made here of what is kept once for all of them.
#ifndef PASSES_SHADERS_VERTEX_GLSL
#define PASSES_SHADERS_VERTEX_GLSL
#include "passes/shaders/uses.glsl"

struct Vertex {
    vec3 position;  // object space of its draw (view space for particles)
    vec3 normal;    // 0: the face's own
    vec4 tangent;   // 0: no normal map
    vec2 uv0;
    vec2 uv1;
    vec4 color;
    vec3 emissive;
    float depth_offset;  // meters towards the eye
};

// Corners go around the quad from its lower left one.
vec3 corner_position(uint particle, uint corner) {
    const vec4 side = corner < 2u ? particle_bottoms[particle] : particle_tops[particle];
    const bool is_first = corner == 0u || corner == 2u;
    return vec3(is_first ? side.xy : side.zw, particle_depths[particle]);
}

Vertex corner_of(DrawRecord emitter, uint own, uint corner) {
    const uint particle = emitter.first_particle + own;
    const vec4 frame = particle_uvs[particle], glow = particle_glows[particle];
    const vec2 at = vec2(corner == 1u || corner == 2u ? 1.0 : 0.0, corner < 2u ? 1.0 : 0.0);
    Vertex v;
    v.position = corner_position(particle, corner);
    v.normal = vec3(0.0, 0.0, -1.0);
    v.tangent = vec4(1.0, 0.0, 0.0, 1.0);
    v.uv0 = frame.xy + frame.zw * at;
    v.uv1 = vec2(0.0);
    v.color = vertex_colors[emitter.colors + own];
    v.emissive = glow.rgb;
    v.depth_offset = glow.w;
    return v;
}

vec3 position_of(uint vertex, uint draw) {
    if (!is_emitter(draw)) return vertex_positions[vertex];
    const uint own = vertex - draws[draw].vertex_offset;
    return corner_position(draws[draw].first_particle + own / 4u, own % 4u);
}

float depth_offset_of(uint vertex, uint draw) {
    if (!is_emitter(draw)) return 0.0;
    return particle_glows[draws[draw].first_particle + (vertex - draws[draw].vertex_offset) / 4u].w;
}

Vertex vertex_of(uint vertex, uint draw) {
    const DrawRecord d = draws[draw];
    const uint own = vertex - d.vertex_offset;
    if (is_emitter(draw)) return corner_of(d, own / 4u, own % 4u);
    Vertex v;
    v.position = vertex_positions[vertex];
    v.normal = vec3(0.0);
    v.tangent = vec4(0.0);
    v.uv0 = v.uv1 = vec2(0.0);
    v.color = vec4(1.0);
    v.emissive = vec3(0.0);
    v.depth_offset = 0.0;
    if (has_attribute(attribute_normal) && d.normals != no_index) v.normal = vertex_normals[d.normals + own];
    if (has_attribute(attribute_tangent) && d.tangents != no_index) v.tangent = vertex_tangents[d.tangents + own];
    if (has_attribute(attribute_uv0) && d.uv0 != no_index) v.uv0 = vertex_uvs[d.uv0 + own];
    if (has_attribute(attribute_uv1) && d.uv1 != no_index) v.uv1 = vertex_uvs[d.uv1 + own];
    if (has_attribute(attribute_color) && d.colors != no_index) v.color = vertex_colors[d.colors + own];
    return v;
}

#endif
