#include "capture_format/export/gltf_glass.h"

#include <algorithm>

namespace strata::to_gltf_parts {
namespace {

/// For channel i, with b reflected, k transmitted, m the mean and T = 1 - R: color c = b / (1 - s) must be at most 1, so
/// s <= 1 - b; the attenuation k / (c m s T) must be at most 1, so s >= k / (k + b m T). One s must do for all channels.
Glass glass_with(const GlassWanted& wanted, double ior, double passes) {
    Glass glass;
    glass.ior = ior;
    double least = 0, most = 1;
    for (int i = 0; i < 3; ++i) {
        const double b = wanted.reflected[i], k = wanted.transmitted[i], through = b * wanted.texture_mean[i] * passes;
        most = std::min(most, 1 - b);
        if (k > 0) least = std::max(least, k / (k + through));
    }
    constexpr double rounding = 1e-6;  // of the floats the material is made of
    glass.is_exact = least <= most + rounding;
    glass.share = std::clamp(least, 0.0, std::max(most, 0.0));
    for (int i = 0; i < 3; ++i) {
        const double k = wanted.transmitted[i], mean = wanted.texture_mean[i] * passes;
        // nothing is reflected where everything goes through: then the color is free, and takes what the mean leaves of k
        const bool is_free = glass.share >= 1 - rounding;
        glass.color[i] =
            is_free ? std::min(mean > 0 ? k / mean : 0.0, 1.0) : std::min(wanted.reflected[i] / (1 - glass.share), 1.0);
        const double through = glass.color[i] * mean * glass.share;
        glass.attenuation[i] = through > 0 ? std::min(k / through, 1.0) : 1.0;
        if (through * glass.attenuation[i] < k - rounding) glass.is_exact = false;
    }
    return glass;
}

}  // namespace

Glass glass_of(const GlassWanted& wanted) {
    const Glass usual = glass_with(wanted, 1.5, 1 - 0.04);
    return usual.is_exact ? usual : glass_with(wanted, 1, 1);
}

}  // namespace strata::to_gltf_parts
