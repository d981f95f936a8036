#include "ui/picture/look_bytes.h"

#include <algorithm>
#include <cmath>

#include "passes/luminance.h"
#include "replay/images/image_io.h"

namespace strata::ui {
namespace {

std::byte byte_of(double share) { return static_cast<std::byte>(std::lround(std::clamp(share, 0.0, 1.0) * 255)); }

/// A polynomial fit of the Turbo map (A. Mikhailov, "Turbo, an improved rainbow colormap", 2019), as the shader has it.
std::array<std::byte, 3> turbo(double x) {
    constexpr double fit[3][6] = {{0.13572138, 4.61539260, -42.66032258, 132.13108234, -152.94239396, 59.28637943},
                                  {0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604},
                                  {0.10667330, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973}};
    std::array<std::byte, 3> made{};
    for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t power = 6; power-- > 0;) sum = sum * x + fit[c][power];
        made[c] = byte_of(sum);
    }
    return made;
}

int channel_of(Channels channels) {
    return channels >= Channels::red && channels <= Channels::alpha ? static_cast<int>(channels) - static_cast<int>(Channels::red)
                                                                    : 0;
}

}  // namespace

std::array<std::byte, 3> shown_bytes(const Look& look, const glm::dvec4& texel) {
    bool is_nan = false, is_infinite = false;
    for (int c = 0; c < 4; ++c) {
        is_nan |= std::isnan(texel[c]);
        is_infinite |= std::isinf(texel[c]);
    }
    if (is_nan) return {byte_of(1), byte_of(0), byte_of(1)};
    if (is_infinite) return {byte_of(1), byte_of(.6), byte_of(0)};
    const float range = look.white == look.black ? 1e-30f : look.white - look.black;
    const auto scaled = [&](double value) {
        return double{static_cast<float>(value) * (std::exp2(look.exposure) / range) - look.black / range};
    };
    const auto encoded = [&](double value) {
        return look.curve == Curve::srgb ? display_byte(scaled(value)) : byte_of(scaled(value));
    };
    switch (look.channels) {
        case Channels::color:
            return {encoded(texel.x), encoded(texel.y), encoded(texel.z)};
        case Channels::false_color:
            return turbo(std::clamp(scaled(texel.x), 0.0, 1.0));
        case Channels::luminance: {
            const std::byte gray = encoded(luminance(glm::dvec3(texel)));
            return {gray, gray, gray};
        }
        default: {
            const std::byte gray = encoded(texel[channel_of(look.channels)]);
            return {gray, gray, gray};
        }
    }
}

ImU32 shown_color(const Look& look, const glm::dvec4& texel) {
    const auto bytes = shown_bytes(look, texel);
    return IM_COL32(static_cast<int>(bytes[0]), static_cast<int>(bytes[1]), static_cast<int>(bytes[2]), 255);
}

}  // namespace strata::ui
