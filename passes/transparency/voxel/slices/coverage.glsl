// Where a transparent triangle may be seen, without rasterizing it: between which depths, and in which columns
// (docs/algorithms/transparency.md 6.8). depth_warp_model.cpp has the same in double. A shader that includes this declares `VoxelPush
// push` in its push constants first.
#ifndef PASSES_TRANSPARENCY_VOXEL_COVERAGE_GLSL
#define PASSES_TRANSPARENCY_VOXEL_COVERAGE_GLSL
#extension GL_GOOGLE_include_directive : require
#include "passes/shaders/vertex.glsl"
#include "passes/transparency/voxel/slices/depth_curve.glsl"

struct DrawCommand {
    uint index_count, instance_count, first_index;
    int vertex_offset;
    uint first_instance;
};
layout(set = 0, binding = 1, scalar) readonly buffer Commands { DrawCommand commands[]; };
layout(constant_id = 0) const uint first_command = 0u;

struct Triangle {
    vec3 corners[3];
    float depth_offset;
    float nearest, farthest;  // of the corners
};

Triangle triangle_of(DrawCommand command, uint index) {
    Triangle triangle;
    triangle.nearest = 3.4e38;
    triangle.farthest = 0.0;
    for (uint i = 0u; i < 3u; ++i) {
        const uint vertex = int(indices[command.first_index + 3u * index + i]) + command.vertex_offset, draw = command.first_instance;
        triangle.corners[i] = (draws[draw].to_view * vec4(position_of(vertex, draw), 1.0)).xyz;
        triangle.depth_offset = depth_offset_of(vertex, draw);
        triangle.nearest = min(triangle.nearest, triangle.corners[i].z);
        triangle.farthest = max(triangle.farthest, triangle.corners[i].z);
    }
    return triangle;
}

bool is_seen(Triangle triangle) { return triangle.farthest > view.near; }

// Columns are counted from the image's left upper corner and need not be whole.
vec2 ray_of(vec2 column) {
    const vec2 ndc = vec2(2.0, -2.0) * column / vec2(push.width, push.height) + vec2(-1.0, 1.0);
    return (ndc - view.ndc_offset) / view.ndc_scale;
}

vec2 column_of(vec3 position) {
    const vec2 ndc = view.ndc_scale * position.xy / position.z + view.ndc_offset;
    return (ndc * vec2(0.5, -0.5) + 0.5) * vec2(push.width, push.height);
}

struct Rays {
    vec2 low, high;  // z = 1
};

Rays rays_through(vec2 first_column, vec2 end_column) {
    const vec2 a = ray_of(first_column), b = ray_of(end_column);
    return Rays(min(a, b), max(a, b));
}

// The least and the most that dot(plane, ray) reaches.
vec2 reached(Rays rays, vec3 plane) {
    const vec2 a = plane.xy * rays.low, b = plane.xy * rays.high, least = min(a, b), most = max(a, b);
    return plane.z + vec2(least.x + least.y, most.x + most.y);
}

// View depths of the triangle where these rays may meet it; .x > .y: nowhere. The plane through the eye and an edge tells on which
// side of it the rays pass, the triangle's own plane what depths they meet: nothing needs to be clipped.
vec2 depths_within(Triangle triangle, Rays rays) {
    const vec3 a = triangle.corners[0], area = cross(triangle.corners[2] - a, triangle.corners[1] - a);
    const float volume = dot(a, area), facing = length(area) * length(a);
    vec2 depths = vec2(max(triangle.nearest, view.near), triangle.farthest) * vec2(1.0 - depth_slack, 1.0 + depth_slack);
    if (abs(volume) * steepest < facing) return depths;
    for (uint i = 0u; i < 3u; ++i) {
        const vec3 corner = triangle.corners[i];
        const vec3 edge = cross(corner, triangle.corners[(i + 1u) % 3u] - corner);
        if (reached(rays, volume < 0.0 ? edge : -edge).y < -ray_slack * length(edge)) return vec2(1.0, 0.0);
    }
    const vec2 inverse = reached(rays, area / volume);
    const float slack = depth_slack * facing / abs(volume);
    if (inverse.y <= 0.0) return vec2(1.0, 0.0);
    depths.x = max(depths.x, (1.0 - slack) / inverse.y);
    if (inverse.x > 0.0) depths.y = min(depths.y, (1.0 + slack) / inverse.x);
    return depths;
}

// Of the 32 bits of a word of a list of bits: those from first to last, both included.
uint bits_between(uint word, uint first, uint last) {
    uint bits = 0xffffffffu;
    if (word == first / 32u) bits &= 0xffffffffu << first % 32u;
    if (word == last / 32u) bits &= 0xffffffffu >> 31u - last % 32u;
    return bits;
}

#endif
