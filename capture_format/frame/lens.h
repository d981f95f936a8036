// Lens and film of a frame.
#pragma once

namespace strata {

struct Lens {
    float bloom = 0, bloom_threshold = 1;
    bool auto_exposure = false;
    float exposure_speed = 1;
    float focus_distance = 0, aperture = 0;  ///< meters; aperture 0 is a pinhole
    bool distortion = false;
};

struct Film {
    float grain = 0, fade = 0;
    float white = 1.7f;  ///< Wt of the tone curve x (1 + x / Wt^2) / (1 + x)
};

}  // namespace strata
