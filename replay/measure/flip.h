// FLIP: how different two pictures look to a person who switches between them. 0: the same; 1: as different as can be.
//
// Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", HPG 2020 (display light), and "Visualizing Errors in
// Rendered High Dynamic Range Images", Eurographics Short Papers 2021 (radiance, over a range of exposures).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "replay/images/host_image.h"

namespace strata {

/// Linear light with BT.709 primaries, one plane per channel, rows top to bottom.
struct ColorPlanes {
    std::uint32_t width = 0, height = 0;
    std::array<std::vector<float>, 3> rgb;
    std::vector<bool> broken;  ///< empty, or one per pixel: a sample of it is NaN or infinite (it reads as black)
};

/// The first three channels; layers are samples and are averaged. A single channel is gray. Bytes are sRGB, as in a PNG.
ColorPlanes color_planes(const HostImage&);
/// The same of an image in double.
ColorPlanes color_planes(const ReferenceImage&);

/// Seen from 0.7 m on a monitor 0.7 m wide of 3840 pixels: 67.02.
inline constexpr double pixels_per_degree_of_a_desk = 3840 * 3.14159265358979323846 / 180;

/// Radiance is tone mapped at `count` exposures, evenly spaced from start to stop.
struct ExposureRange {
    double start = 0, stop = 0;  ///< log2 of the factor
    std::uint32_t count = 0;     ///< 0: display light, no exposure
};
/// One exposure per stop and at least two.
ExposureRange exposure_range(double start, double stop);

/// Curves from radiance to display light: Narkowicz's fit of ACES without its pre-exposure of 0.6, Hable's filmic curve (both per
/// channel) and Reinhard's L / (1 + L) of the luminance, with the constants of the authors' program.
enum class ToneMapper { aces, hable, reinhard };
inline constexpr std::array<std::string_view, 3> tone_mapper_names = {"aces", "hable", "reinhard"};
std::string_view name(ToneMapper);

/// How a person looks at the pictures.
struct FlipOptions {
    double pixels_per_degree = pixels_per_degree_of_a_desk;
    // Of radiance:
    ToneMapper tone_mapper = ToneMapper::aces;
    std::optional<ExposureRange> exposures = std::nullopt;  ///< unset: those that show the reference, see exposures_of()
};

struct Flip {
    std::uint32_t width = 0, height = 0;
    std::vector<float> map;  ///< 0..1 per pixel
    double mean = 0;
    /// Quantiles of the map in which every pixel weighs what its error is: half of all error is in pixels above the median.
    double low = 0, first_quartile = 0, median = 0, third_quartile = 0, high = 0;
    ExposureRange exposures;
    std::vector<std::uint8_t> exposure;  ///< radiance: which exposure gave the pixel's error; else empty
};

/// Of display light, 0..1. Sizes are equal (asserted). A pixel that only one picture has a number for is 1.
Flip display_flip(const ColorPlanes& reference, const ColorPlanes& test, double pixels_per_degree = pixels_per_degree_of_a_desk);

/// Of radiance: the worst over the exposures.
Flip radiance_flip(const ColorPlanes& reference, const ColorPlanes& test, const FlipOptions& = {});

/// From where the brightest pixel reaches 85 % of white to where the median one does, through the tone mapper (2021, section 3).
/// The median is that of the authors' program: the mean of the sorted luminances n / 2 - 1 and n / 2. Where it is black: the
/// median of what is not. Of a black reference: the test's own, so that it is judged, too. At most 32 exposures.
ExposureRange exposures_of(const ColorPlanes& reference, const ColorPlanes& test, ToneMapper = ToneMapper::aces);

}  // namespace strata
