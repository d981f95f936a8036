// What a draw of the inspector's renderer knows beside its triangles.
#ifndef UI_IMGUI_LAYER_SHARED_H
#define UI_IMGUI_LAYER_SHARED_H
#include "passes/shader_interop.h"

#ifdef __cplusplus
namespace strata::ui {
#endif

const uint look_widgets = 0u;      // fonts and shapes: a texture times the vertex color
const uint look_color = 1u;        // red, green and blue
const uint look_channel = 2u;      // one channel as gray
const uint look_luminance = 3u;    // Rec. 709
const uint look_false_color = 4u;  // one channel from dark blue to dark red
const uint look_kinds = 5u;
const uint curve_raw = 0u;  // 0..1 to 0..255
const uint curve_srgb = 1u;
const uint curve_kinds = 2u;

struct LayerPush {
    vec2 to_clip;
    vec2 clip_offset;
    float scale;  // a shown value is texel * scale + offset, black at 0 and white at 1
    float offset;
    uint channel;  // of look_channel and look_false_color
};

#ifdef __cplusplus
}  // namespace strata::ui
#endif
#endif
