// Dear ImGui's triangles: pixels of the target to clip space.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "ui/window/imgui_layer.shared.h"

layout(push_constant, scalar) uniform Push { LayerPush push; };

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;

layout(location = 0) out vec2 out_uv;
layout(location = 1) out vec4 out_color;

void main() {
    out_uv = uv;
    out_color = color;
    gl_Position = vec4(position * push.to_clip + push.clip_offset, 0, 1);
}
