// What the effects of the lens and their shaders share.
#ifndef PASSES_LENS_SHARED_H
#define PASSES_LENS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::lens {
#endif

// exposure
const uint exposure_exponential = 0u;
const uint exposure_xray = 1u;
const uint exposure_off = 2u;
// bloom
const uint bloom_pyramid = 0u;
const uint bloom_xray = 1u;
const uint bloom_off = 2u;
// focus
const uint focus_gather = 0u;
const uint focus_xray = 1u;
const uint focus_off = 2u;
// focus_taps
const uint focus_taps_16 = 0u;
const uint focus_taps_64 = 1u;
const uint focus_taps_128 = 2u;
const uint focus_taps_256 = 3u;
// distortion
const uint distortion_radial = 0u;
const uint distortion_off = 1u;

// Largest half float: what is brighter counts as this bright, and what is not a number as nothing.
const float brightest = 65504.0f;

// ---- exposure (docs/algorithms/deferred.md 8.5)

// Time in two's complement, low word first: 2^20 ticks are a second.
const float ticks_per_second = 1048576.0f;

// What a frame leaves to the next.
struct ExposureState {
    float exposure;
    float share;  // exposure=xray: the share f of the way to the target that the frame went
    uint is_set;
    uvec2 ticks;
};

struct HeldPush {
    uvec2 ticks;
};

// Pixels that a group measures.
const uint meter_tile = 16u;
const uint meter_threads = 256u;

struct MeterRecord {
    float sum;    // of luminance, over samples
    float count;  // samples that are numbers
};

struct AdaptPush {
    uvec2 ticks;
    uint tiles;
    float speed;   // per second
    float amount;  // 0: the exposure stays 1
    float gray;    // luminance that is shown as it is
};

// Luminance of black, and the bounds that X-Ray computes and discards.
const float exposure_low = 1e-4f;
const float least_exposure = 1.0f / 128.0f;
const float most_exposure = 20.0f;
// Hi of docs/algorithms/deferred.md 8.1 clips here.
const float hi_end = 9.0f;

// ---- bloom (8.6)

struct BrightPush {
    float threshold;  // of exposed radiance
};

struct GlowPush {
    float strength;
};

const uint xray_extent = 256u;
const float xray_threshold = 1e-5f;
// Weights of a center and of seven taps to each side of it.
struct XrayBlurPush {
    float weights[8];
};

// ---- depth of field (8.7)

const uint blur_tile = 8u;

struct BlurPush {
    float scale;  // pixels: radius of the blur of what is infinitely far
    float focus;  // meters
    float most;   // pixels
};

// X-Ray's meters, and the radius of its taps in uv: kernel 5 in half pixels of 1024 x 768.
const float xray_near = -1.25f;
const float xray_far = 600.0f;
const float xray_sky = 30.0f;
const float xray_radius_u = 5.0f * 0.5f / 1024.0f;
const float xray_radius_v = 5.0f * 0.5f / 768.0f;

// ---- distortion (8.8)

struct RadialPush {
    float k1;
    float scale;  // of the whole picture
};

#ifdef __cplusplus
}
#endif
#endif
