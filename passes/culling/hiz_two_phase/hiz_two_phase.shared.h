// What two-phase occlusion culling's C++ and its shaders share.
#ifndef PASSES_CULLING_HIZ_TWO_PHASE_SHARED_H
#define PASSES_CULLING_HIZ_TWO_PHASE_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// Bounds on the picture are widened by so many pixels: positions snap to 1/256, and float bounds are good to less than that.
const float pixel_slack = 1.0f / 64.0f;
// A draw is hidden when its nearest possible depth, nearer by this share, is still behind: float interpolation of depth is good
// to some 2^-20 of it, of triangles seen edge-on to less. 1 cm at 40 m.
const float depth_slack = 1.0f / 4096.0f;

const uint phases_one = 0u;
const uint phases_two = 1u;

// What is known of a draw, in HizDraw::state.
const uint hiz_in_view = 1u;   // its sphere reaches into the view's pyramid; nothing else is set without it
const uint hiz_at_eye = 2u;    // its sphere reaches over the near plane: it has no bounds and is never hidden
const uint hiz_occludes = 4u;  // it is opaque all over; masked draws are tested and never drawn into the occluders' depth
const uint hiz_known = 8u;     // it was visible the last time
const uint hiz_first = 16u;    // drawn in phase 1
const uint hiz_new = 32u;      // in phase 2 found not to be hidden
const uint hiz_visible = 64u;  // not hidden in the end

struct HizDraw {
    uint state;
    ivec2 first, last;  // pixels, both ends included, in the picture; none where last < first in x or y
    float nearest;      // largest device depth it can have
    uint size_bin;      // of what occludes
};

// Occluders of a cold start are the largest: sizes are counted in bins of an eighth of an octave, of radius over depth from
// 2^-12 to 16. Bits of a positive float are in the order of its value, and its top 3 bits of mantissa part an octave.
const uint size_bins = 128u;
const uint size_bin_shift = 20u;
const uint smallest_size_bin = 920u;  // bits of 2^-12 >> 20

struct HizWork {
    uint first_count;   // commands of phase 1 ...
    uint second_count;  // ... and of phase 2
    uint known;         // draws in view that occlude and were visible the last time
    uint sizes[size_bins];
};

struct HizPush {
    uint first;      // command of the list's draw 0
    uint count;      // draws in the list
    uint occluders;  // of a cold start, at the most
    uint across;     // texels of the pyramid that bounds are looked up in, in x and in y
    uint phases;
};

// A dispatch makes four levels from one; the first makes that one, too.
const uint levels_per_dispatch = 4u;
const uint pyramid_group = 16u;  // texels of the level it starts from, in x and in y

// What view.comp shows.
const uint hiz_view_pyramid = 0u;
const uint hiz_view_hidden = 1u;
const uint hiz_view_bounds = 2u;

struct HizView {
    uint count;
    uint level;
};

struct HizCounters {
    uint in_view;
    uint drawn_first;
    uint tested;
    uint newly_visible;
    uint occluded;
    uint pyramid_texels;
};

#ifdef __cplusplus
}
#endif
#endif
