// Three quarters of the step that the targets' floats have at 1: added to 1 and rounded, they are 0 or a whole one.
#version 460

layout(location = 0) out vec4 out_half;    // 10 bits behind the leading one
layout(location = 1) out vec4 out_packed;  // 6 bits, blue 5

void main() {
    out_half = vec4(0.75 / 1024.0);
    out_packed = vec4(0.75 / 64.0, 0.75 / 64.0, 0.75 / 32.0, 0.0);
}
