// Push constants of every shader of the peer, as in spheres.h, and the nodes of its lists.
layout(push_constant) uniform Scene {
    mat4 to_clip;
    vec3 sky;
    uint nodes;
    vec3 ground;
    uint padding;
    vec3 background;
    uint width;
    vec3 up;
    uint height;
};

struct Node {
    uvec2 color;  // four halves, premultiplied
    float depth;  // larger is nearer
    uint next;
};

const uint no_node = 0xffffffffu;
