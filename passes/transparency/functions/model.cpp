#include "passes/transparency/functions/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <tbb/enumerable_thread_specific.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame_features.h"
#include "capture_format/view.h"
#include "passes/stage_input.h"
#include "passes/transparency/distortion/model.h"
#include "passes/transparency/functions/tint_model.h"
#include "passes/transparency/low_resolution/model.h"
#include "passes/transparency/rounding.h"

namespace strata::transparency {
namespace {

/// Adds and rounds as blending into the format does.
double blended(double sum, double term, const Summing& how, SmallFloat format) {
    return how.accumulation == accumulation_single ? sum + term : rounded(sum + term, format, how.rounding);
}

SmallFloat color_format(std::uint32_t accumulation, int channel) {
    if (accumulation != accumulation_packed) return half_float;
    return channel == 2 ? float10 : float11;
}

bool is_chromatic(const Frame& frame) { return frame_features(frame).has(Feature::chromatic); }

struct Sums {
    glm::dvec3 color{0}, extinction{0}, normalizer{0}, emission{0};
    glm::dvec2 offset{0}, skew{0};

    Sums& operator+=(const Sums& other) {
        color += other.color;
        extinction += other.extinction;
        normalizer += other.normalizer;
        emission += other.emission;
        offset += other.offset;
        skew += other.skew;
        return *this;
    }
    friend Sums operator*(const Sums& s, double share) {
        return {s.color * share,    s.extinction * share, s.normalizer * share,
                s.emission * share, s.offset * share,     s.skew * share};
    }
};

/// Adds N and X of one channel and the depths that skew, and returns what of the fragment is then skewed.
Fragment tinted(const Fragment& fragment, double through, const Summing& how, Sums& sums) {
    const glm::dvec2 depths = skew_depths(fragment, through * fragment.fog);
    const double t = luminance(fragment.transmittance);
    const auto add = [&](double& sum, double term) { sum = blended(sum, term, how, half_float); };
    add(sums.normalizer.x, (1 - t) * through);
    add(sums.normalizer.y, optical_depth_in_double(t));
    for (int i = 0; i < 2; ++i) add(sums.skew[i], depths[i]);
    Fragment seen = fragment;
    if (how.tint != tint_corrected) return seen;
    seen.color /= skew(depths);
    seen.emission /= skew(depths);
    return seen;
}

Sums sums_of(std::span<const Fragment> fragments, const Transmittance& transmittance, const Summing& how) {
    Sums sums;
    for (const Fragment& drawn : fragments) {
        const glm::dvec3 through = transmittance(drawn);
        if (how.unseen == Unseen::adds_nothing && through == glm::dvec3(0)) continue;
        const Fragment fragment = how.tint != tint_total ? tinted(drawn, through.x, how, sums) : drawn;
        for (int axis = 0; axis < 2; ++axis)
            sums.offset[axis] = blended(sums.offset[axis], fragment.distortion[axis] * luminance(through), how, half_float);
        for (int c = 0; c < 3; ++c) {
            // Gray extinction and weights are one half float each, whatever the color's format.
            const SmallFloat color = color_format(how.accumulation, c), weight = how.chromatic ? color : half_float;
            const auto add = [&](double& sum, double term, SmallFloat format) { sum = blended(sum, term, how, format); };
            add(sums.color[c], std::min(fragment.color[c], double(largest_radiance)) * through[c], color);
            add(sums.extinction[c], optical_depth_in_double(fragment.transmittance[c]), weight);
            if (how.tint == tint_total) add(sums.normalizer[c], (1 - fragment.transmittance[c]) * through[c], weight);
            add(sums.emission[c], std::min(fragment.emission[c], double(largest_radiance)) * through[c], color);
        }
    }
    return sums;
}

double factor(double extinction, double normalizer) {
    return normalizer > double(least_normalizer) ? -std::expm1(-extinction) / normalizer : 1;
}

glm::dvec3 resolved(const Sums& sums, glm::dvec3 behind, std::uint32_t tint) {
    const glm::dvec3 through = glm::exp(-sums.extinction);
    if (tint != tint_total) {
        const glm::dvec3 over = sums.color * factor(sums.normalizer.y, sums.normalizer.x) + sums.emission;
        return behind * through + over * skew(sums.skew);
    }
    glm::dvec3 over = sums.emission;
    for (int c = 0; c < 3; ++c) over[c] += sums.color[c] * factor(sums.extinction[c], sums.normalizer[c]);
    return behind * through + over;
}

/// The fragments that a prepass is made of; `own` keeps them where they are not those that are blended.
const FragmentLists& fragments_of_prepass(const StageInput& input, const PrepassModel& model, std::optional<FragmentLists>& own) {
    const ReferenceImage& color = input.before.at("color");
    const View& view = input.frame.view;
    const Extent whole{view.width, view.height}, extent = prepass_extent(whole, model.divisor);
    const bool is_tested = model.tested == PrepassModel::Tested::against_opaque;
    if (is_tested && extent == whole && view.samples == 1) return fragments_of(input, color, own);
    Frame low = input.frame;
    low.view.width = extent.width;
    low.view.height = extent.height;
    low.view.samples = 1;
    const ImageSet nothing;
    const ReferenceImage depth = opaque_depth(is_tested ? input.before : nothing, color);
    return own.emplace(fragments_before(low, farthest_depth(depth, extent), input.before));
}

/// What a prepass keeps of its texels, computed when it is read. Each thread keeps two rows of it: the whole of
/// smoke_grenade at 320 x 180 takes 236 MB at 512 slices, twice as much as its fragments.
class Projected {
public:
    Projected(const StageInput& input, const PrepassModel& model)
        : model_(&model), fragments_(&fragments_of_prepass(input, model, own_)) {}
    Projected(const Projected&) = delete;

    glm::uvec2 extent() const { return {fragments_->width(), fragments_->height()}; }
    /// Whether the texel's coverage hangs on rounding.
    bool is_undecided(glm::uvec2 texel) const { return fragments_->undecided(texel.x, texel.y); }
    /// Valid until the thread reads a texel of another row whose y differs by an even number.
    std::span<const double> numbers(glm::uvec2 texel) {
        Rows& rows = rows_.local();
        Row& row = rows[texel.y % rows.size()];
        if (row.y != texel.y) row = {texel.y, std::vector<std::optional<std::vector<double>>>(fragments_->width())};
        std::optional<std::vector<double>>& kept = row.numbers[texel.x];
        if (!kept) kept = model_->project(fragments_->at(texel.x, texel.y), texel);
        return *kept;
    }

private:
    struct Row {
        std::optional<std::uint32_t> y;
        std::vector<std::optional<std::vector<double>>> numbers;  ///< by x
    };
    const PrepassModel* model_;
    std::optional<FragmentLists> own_;
    const FragmentLists* fragments_;
    using Rows = std::array<Row, 2>;
    tbb::enumerable_thread_specific<Rows> rows_;
};

/// The texel of another image under a pixel's center.
glm::uvec2 texel_under(glm::uvec2 pixel, glm::uvec2 extent, glm::uvec2 other) {
    return (2u * pixel + 1u) * other / (2u * extent);
}

/// What is read under a pixel's center.
struct Read {
    std::vector<double> numbers;
    glm::uvec2 texel{0};  ///< the nearest
    bool undecided = false;
};

/// Bilinear, clamped at the edges, or the nearest texel.
Read read_at(Projected& projected, const PrepassModel& model, glm::uvec2 extent, glm::uvec2 pixel) {
    const glm::uvec2 size = projected.extent();
    Read read{.texel = texel_under(pixel, extent, size)};
    std::array<Tap, 4> taps = bilinear_taps(place_of(pixel, extent), size);
    if (model.filter == PrepassModel::Filter::nearest) taps = {{{read.texel.x, read.texel.y, 1}}};
    for (const Tap& tap : taps) {
        if (tap.share == 0) continue;
        const glm::uvec2 texel(tap.x, tap.y);
        model.add(read.numbers, projected.numbers(texel), tap.share);
        read.undecided = read.undecided || projected.is_undecided(texel);
    }
    return read;
}

/// A T(z), and whether it hangs on rounding.
struct Found {
    Transmittance transmittance;
    bool undecided = false;
};
/// For fragments drawn to a pixel (x, y, sample) of an image of `extent`: the frame's, or half of it.
using Lookup = std::function<Found(std::span<const Fragment>, glm::uvec3 at, glm::uvec2 extent)>;

ImageSet modeled(const StageInput& input, const Summing& how, const Lookup& lookup) {
    const auto summed = [&](std::span<const Fragment> fragments, glm::uvec3 at, glm::uvec2 extent) -> LowSums<Sums>::Texel {
        if (fragments.empty()) return {};
        const Found found = lookup(fragments, at, extent);
        return {sums_of(fragments, found.transmittance, how), found.undecided};
    };
    const ReferenceImage& before = input.before.at("color");
    const glm::uvec2 extent(before.width, before.height), half = (extent + 1u) / 2u;
    const LowSums<Sums> low(input, [&](std::span<const Fragment> fragments, glm::uvec2 texel) {
        return summed(fragments, glm::uvec3(texel, 0), half);
    });
    const PlacedBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3 at) -> BlendedSample {
        auto [sums, undecided] = summed(fragments, at, extent);
        const LowSums<Sums>::Texel read = low.at(place_of(glm::uvec2(at), extent));
        sums += read.sums;
        const bool bent = sums.offset != glm::dvec2(0);
        const BlendedSample seen = bent ? seen_behind(before, at, sums.offset) : BlendedSample{behind};
        return {resolved(sums, seen.radiance, how.tint), undecided || read.undecided || seen.undecided};
    };
    return {{"color", blended_at_full_resolution(before, input, blend)}};
}

}  // namespace

void add_numbers(std::vector<double>& sum, std::span<const double> numbers, double share) {
    sum.resize(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) sum[i] += share * numbers[i];
}

double optical_depth_in_double(double t) {
    return t > 0 ? std::min(-std::log(t), double(largest_optical_depth)) : double(largest_optical_depth);
}

double channel_depth(const Fragment& f, std::size_t channel, std::size_t channels) {
    const glm::dvec3 t = f.transmittance;
    return optical_depth_in_double(channels == 3 ? t[static_cast<int>(channel)] : luminance(t));
}

glm::dvec3 function_blend(std::span<const Fragment> fragments, glm::dvec3 behind, const Transmittance& transmittance,
                          const Summing& how) {
    return resolved(sums_of(fragments, transmittance, how), behind, how.tint);
}

ImageSet function_model(const StageInput& input, std::uint32_t accumulation, const FunctionOfSample& function) {
    const Summing how{accumulation, input.rounding, is_chromatic(input.frame)};
    if (!frame_features(input.frame).has(Feature::low_resolution))
        return modeled(input, how,
                       [&](std::span<const Fragment> fragments, glm::uvec3, glm::uvec2) { return Found{function(fragments)}; });
    // T is that of all fragments, of whichever resolution, of the sample under the center.
    const ReferenceImage& before = input.before.at("color");
    std::optional<FragmentLists> own;
    const FragmentLists& all = fragments_of(input, before, own);
    return modeled(input, how, [&](std::span<const Fragment>, glm::uvec3 at, glm::uvec2 extent) {
        const glm::uvec2 pixel = texel_under(glm::uvec2(at), extent, {before.width, before.height});
        return Found{function(all.at(pixel.x, pixel.y, at.z)), all.undecided(pixel.x, pixel.y, at.z)};
    });
}

ImageSet function_model(const StageInput& input, std::uint32_t accumulation, const PrepassModel& model) {
    Projected projected(input, model);
    // What a T(z) looks up lives as long as its thread's pixel does.
    tbb::enumerable_thread_specific<Read> reads;
    const bool chromatic = is_chromatic(input.frame);
    const Summing how{accumulation, input.rounding, chromatic, model.unseen, chromatic ? model.tint : tint_total};
    return modeled(input, how, [&](std::span<const Fragment>, glm::uvec3 at, glm::uvec2 extent) {
        Read& read = reads.local();
        read = read_at(projected, model, extent, glm::uvec2(at));
        return Found{model.function(read.numbers, read.texel), read.undecided};
    });
}

}  // namespace strata::transparency
