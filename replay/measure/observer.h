// What a person sees of a picture, and how two pictures differ in it: the map of FLIP for one exposure. Float, planar, rows in
// parallel; separable filters; compiled without math errors (replay/CMakeLists.txt), so that its loops become vector code.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "replay/measure/flip.h"

namespace strata {

/// x -> (above[0] x^2 + above[1] x + above[2]) / (the same of below), at most 1: of each channel, or of the luminance for all
/// three.
struct ToneCurve {
    std::array<float, 3> above, below;
    bool of_luminance = false;
};
ToneCurve tone_curve(ToneMapper);

/// How radiance becomes display light.
struct Exposed {
    double exposure = 0;  ///< log2 of the factor
    ToneMapper tone_mapper = ToneMapper::aces;
};

/// Weights at distance 0, 1, ... on one side; the other side is the same, or its negative.
struct FlipKernel {
    std::vector<float> weights;
    enum class Symmetry { even, odd } symmetry = Symmetry::even;
};

/// Keeps its filters and its planes from one comparison to the next.
class Observer {
public:
    Observer(std::uint32_t width, std::uint32_t height, double pixels_per_degree);

    /// FLIP per pixel, 0..1, of two pictures of the observer's size: of display light, or exposed and tone mapped first.
    std::span<const float> compare(const ColorPlanes& reference, const ColorPlanes& test, const std::optional<Exposed>&);

private:
    // What is left of a picture after its rows are filtered; the columns' filters make the rest of it.
    enum Plane { luminance, red_green, blue_yellow_wide, blue_yellow_narrow, smooth, slope, bend, plane_count };
    using Planes = std::array<std::vector<float>, plane_count>;
    struct Rows;

    void filter_rows(const ColorPlanes&, const std::optional<Exposed>&, Planes&) const;
    void filter_columns(const Planes&, std::uint32_t y, Rows&) const;
    void compare_row(const Rows& reference, const Rows& test, std::span<float> out) const;

    std::uint32_t width_, height_;
    std::size_t stride_;  ///< floats from row to row
    std::array<FlipKernel, plane_count> across_;
    FlipKernel down_wide_, down_narrow_;  ///< of blue_yellow: with the shares of the two Gaussians
    float knee_ = 0, largest_ = 0;        ///< of the color difference
    Planes reference_, test_;
    std::vector<float> map_;
};

}  // namespace strata
