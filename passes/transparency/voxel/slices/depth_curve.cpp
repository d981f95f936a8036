#include "passes/transparency/voxel/slices/depth_curve.h"

#include <algorithm>
#include <cmath>

namespace strata::transparency {

double DepthCurve::slice_of(double z) const {
    return slices * std::log1p((z - nearest) / linear) / std::log1p((farthest - nearest) / linear);
}

double DepthCurve::depth_of(double slice) const {
    return nearest + linear * std::expm1(slice / slices * std::log1p((farthest - nearest) / linear));
}

double DepthCurve::thickness_at(double z) const {
    return (z - nearest + linear) * std::log1p((farthest - nearest) / linear) / slices;
}

double linear_of_thickness(double slices, double range, double near_thickness) {
    // The left side grows with a, so bisection in its logarithm cannot miss.
    double low = std::log(1e-9 * range), high = std::log(10 * range);
    for (int i = 0; i < 100; ++i) {
        const double middle = .5 * (low + high), a = std::exp(middle);
        (a * std::log1p(range / a) < slices * near_thickness ? low : high) = middle;
    }
    return std::exp(high);
}

DepthRange voxel_range(const VoxelParams& params, DepthRange world, double deepest, float near) {
    if (params.range == range_fixed) return {0, params.farthest};
    const auto half = static_cast<float>(deepest / 2);
    return {std::max(world.nearest - half, std::min(world.nearest, near)), world.farthest + half};
}

DepthCurve depth_curve(const VoxelParams& params, DepthRange range) {
    constexpr double inch = .0254;  // a = n is the talk's, whose unit is the inch
    DepthCurve curve{.slices = double(params.slices), .farthest = double(range.farthest), .nearest = double(range.nearest)};
    switch (params.curve) {
        case curve_thickness:
            curve.linear = linear_of_thickness(curve.slices, curve.farthest - curve.nearest, double(params.near_thickness));
            break;
        case curve_linear:
            curve.linear = double(params.linear);
            break;
        default:
            curve.linear = curve.slices * inch;
    }
    if (params.volume == volume_dense) return curve;
    curve.slices = most_virtual_slices;
    const auto too_thin = [&] { return curve.thickness_at(curve.nearest) < double(params.thinnest); };
    while (curve.slices >= 2 * params.slices && too_thin()) curve.slices /= 2;
    return curve;
}

}  // namespace strata::transparency
