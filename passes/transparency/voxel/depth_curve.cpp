#include "passes/transparency/voxel/depth_curve.h"

#include <cmath>

namespace strata::transparency {

double DepthCurve::slice_of(double z) const { return slices * std::log1p(z / linear) / std::log1p(farthest / linear); }

double DepthCurve::depth_of(double slice) const { return linear * std::expm1(slice / slices * std::log1p(farthest / linear)); }

double DepthCurve::thickness_at(double z) const { return (z + linear) * std::log1p(farthest / linear) / slices; }

double linear_of_thickness(double slices, double farthest, double near_thickness) {
    // The left side grows with a, so bisection in its logarithm cannot miss.
    double low = std::log(1e-9 * farthest), high = std::log(10 * farthest);
    for (int i = 0; i < 100; ++i) {
        const double middle = .5 * (low + high), a = std::exp(middle);
        (a * std::log1p(farthest / a) < slices * near_thickness ? low : high) = middle;
    }
    return std::exp(high);
}

DepthCurve depth_curve(const VoxelParams& params) {
    constexpr double inch = .0254;  // a = n is the talk's, whose unit is the inch
    const double n = params.slices, farthest = double(params.farthest);
    const bool by_thickness = params.curve == curve_thickness;
    const double a = by_thickness ? linear_of_thickness(n, farthest, double(params.near_thickness)) : n * inch;
    return {.slices = n, .linear = a, .farthest = farthest};
}

}  // namespace strata::transparency
