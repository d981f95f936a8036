// Widgets, and images as their look says. An image that is shown as it is gives the very bytes that a written PNG has: the sRGB
// curve is corrected by the table of where one byte ends and the next begins (display_byte of replay/images/image_io.h).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "ui/window/imgui_layer.shared.h"

layout(push_constant, scalar) uniform Push { LayerPush push; };
layout(set = 0, binding = 0) uniform sampler2D image;
layout(set = 0, binding = 1, scalar) readonly buffer ByteEnds { float byte_ends[255]; };

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;

layout(location = 0) out vec4 out_color;

// Of the pipeline: llvmpipe (Mesa 22.3) runs both sides of every branch, and a widget's pixels would take as long as an image's.
layout(constant_id = 0) const uint kind = look_widgets;
layout(constant_id = 1) const uint curve = curve_raw;

const int widest = 4;  // texels averaged across, where an image is shown smaller than it is

float byte_of(float light) {
    float curved = light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1.0 / 2.4) - 0.055;
    int guess = int(clamp(curved, 0.0, 1.0) * 255.0 + 0.5);
    if (guess < 255 && light >= byte_ends[min(guess, 254)]) ++guess;
    else if (guess > 0 && light < byte_ends[max(guess - 1, 0)]) --guess;
    return float(guess) / 255.0;
}

float encoded(float value) { return curve == curve_srgb ? byte_of(value) : clamp(value, 0.0, 1.0); }

// A polynomial fit of the Turbo map (A. Mikhailov, "Turbo, an improved rainbow colormap", 2019).
vec3 turbo(float x) {
    vec4 low = vec4(1, x, x * x, x * x * x);
    vec2 high = low.zw * low.z;
    return vec3(dot(low, vec4(0.13572138, 4.61539260, -42.66032258, 132.13108234)) + dot(high, vec2(-152.94239396, 59.28637943)),
                dot(low, vec4(0.09140261, 2.19418839, 4.84296658, -14.18503333)) + dot(high, vec2(4.27729857, 2.82956604)),
                dot(low, vec4(0.10667330, 12.64194608, -60.58204836, 110.36276771)) + dot(high, vec2(-89.90310912, 27.34824973)));
}

vec4 texel_at(ivec2 at) { return texelFetch(image, clamp(at, ivec2(0), textureSize(image, 0) - 1), 0); }

vec4 averaged(vec2 at, ivec2 across) {
    vec4 sum = vec4(0);
    ivec2 first = ivec2(floor(at - 0.5 * vec2(across - 1)));
    for (int y = 0; y < across.y; ++y)
        for (int x = 0; x < across.x; ++x) sum += texel_at(first + ivec2(x, y));
    return sum / float(across.x * across.y);
}

vec3 shown(vec4 texel) {
    if (kind == look_luminance) return vec3(encoded(dot(texel.rgb, vec3(0.2126, 0.7152, 0.0722)) * push.scale + push.offset));
    if (kind == look_channel) return vec3(encoded(texel[push.channel] * push.scale + push.offset));
    if (kind == look_false_color) return clamp(turbo(clamp(texel[push.channel] * push.scale + push.offset, 0.0, 1.0)), 0.0, 1.0);
    vec3 value = texel.rgb * push.scale + push.offset;
    return vec3(encoded(value.r), encoded(value.g), encoded(value.b));
}

void main() {
    if (kind == look_widgets) {
        out_color = color * texture(image, uv);
        return;
    }
    vec2 at = uv * vec2(textureSize(image, 0));
    ivec2 across = clamp(ivec2(ceil(fwidth(at) - 0.01)), ivec2(1), ivec2(widest));
    vec4 texel = across == ivec2(1) ? texel_at(ivec2(floor(at))) : averaged(at, across);
    bvec4 not_numbers = isnan(texel), endless = isinf(texel);
    vec3 made = shown(texel);
    if (any(endless)) made = vec3(1, 0.6, 0);
    if (any(not_numbers)) made = vec3(1, 0, 1);
    out_color = vec4(made, 1);
}
