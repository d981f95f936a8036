#include "passes/transparency/voxel/thick_fragments/segment_model.h"

#include <algorithm>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/reference/ordering.h"

namespace strata::transparency {

double thickness_of(const VoxelParams& params, const Fragment& f) {
    return has_segments(params) && f.layer == 0 ? f.soft_fade : 0;
}

double thickness_of(const VoxelParams& params, const Frame& frame, std::uint32_t draw) {
    const bool is_thick = has_segments(params) && draw >= frame.draws.size() && layer_of(frame, draw) == 0;
    return is_thick ? double(frame.emitters[draw - frame.draws.size()].soft_depth_fade) : 0;
}

DepthRange voxel_range(const VoxelParams& params, const Frame& frame) {
    double deepest = 0;
    for (const std::uint32_t draw : transparent_draws(frame)) deepest = std::max(deepest, thickness_of(params, frame, draw));
    return voxel_range(params, world_depth_range(frame), deepest, frame.view.near);
}

std::optional<Segment> segment_at(const DepthCurve& curve, double depth, double meters, std::uint32_t splatting) {
    const auto place_of = [&](double z) {
        return std::min(curve.slice_of(std::max(z, curve.nearest)), curve.slices - double(end_margin));
    };
    const double from = place_of(depth - meters / 2), to = place_of(depth + meters / 2);
    if (meters == 0 || (splatting == splatting_linear && to - from < 1)) return {};
    return Segment{curve, depth + meters / 2, meters, static_cast<int>(from), static_cast<int>(to)};
}

std::uint32_t Segment::code_behind(int slice, double codes, double rounding) const {
    if (slice > last) return 0;
    const double share = slice <= first ? 1 : std::clamp((farthest - curve.depth_of(slice)) / meters, 0., 1.);
    return static_cast<std::uint32_t>(codes * share + rounding);
}

std::vector<std::uint32_t> Segment::codes_of_slices(double codes, double rounding) const {
    std::vector<std::uint32_t> parts;
    for (int slice = first; slice <= last; ++slice)
        parts.push_back(code_behind(slice, codes, rounding) - code_behind(slice + 1, codes, rounding));
    return parts;
}

double without_own(const ColumnFormat& format, double integral, double own) {
    return integral >= format.full_code * double(full_share) ? integral : std::max(integral - own, 0.);
}

}  // namespace strata::transparency
