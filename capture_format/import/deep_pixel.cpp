#include "capture_format/import/deep_pixel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

namespace strata {
namespace {

// Cutting costs the square of a pixel's overlapping samples: more than this is a hostile file.
constexpr std::uint64_t most_cuts = std::uint64_t{1} << 31;
constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dvec3 values(const std::array<std::span<const float>, 3>& planes, std::size_t i) {
    return {planes[0][i], planes[1][i], planes[2][i]};
}

/// NaN and infinities become 0. True where there were any.
bool mend(glm::dvec3& color) {
    bool bad = false;
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(color[c])) color[c] = 0, bad = true;
    return bad;
}

/// The sample, or nothing where it has no place in front of the eye.
std::optional<DeepSample> usable_sample(const DeepBlock& block, std::size_t i, DeepCensus& census) {
    DeepSample sample{.depth = double(block.depth[i]), .back = double(block.back[i])};
    ++census.samples;
    if (std::isnan(sample.depth)) return ++census.depth_not_a_number, std::nullopt;
    if (sample.depth <= 0) return ++census.depth_not_in_front, std::nullopt;
    if (sample.depth < nearest_depth) ++census.depth_too_near;
    if (sample.depth > farthest_depth) ++census.depth_infinite, sample.depth = infinity;
    const bool thick = sample.back > sample.depth && sample.back <= farthest_depth;
    if (thick) ++census.volumes;
    else sample.back = sample.depth;

    sample.color = values(block.color, i);
    sample.alpha = values(block.alpha, i);
    if (const bool color = mend(sample.color), alpha = mend(sample.alpha); color || alpha) ++census.bad_color;
    const glm::dvec3 clamped = glm::clamp(sample.alpha, 0.0, 1.0);
    if (clamped != sample.alpha) ++census.bad_alpha;
    sample.alpha = clamped;
    return sample;
}

auto order_of(const DeepSample& s) { return std::tuple(s.depth, s.back, s.index); }
bool is_nearer(const DeepSample& a, const DeepSample& b) { return order_of(a) < order_of(b); }

/// What volumes give between two depths, per channel: optical depth and light per thickness add up; what is opaque hides the
/// others, and several opaque ones share alike.
class MergedCut {
public:
    void add(const DeepSample& volume, double share) {
        for (int c = 0; c < 3; ++c) {
            const double alpha = volume.alpha[c], color = volume.color[c];
            if (alpha >= 1) {
                opaque_light_[c] += color;
                opaque_[c] += 1;
                continue;
            }
            const double depth = -std::log1p(-alpha);
            depth_[c] += share * depth;
            light_[c] += share * color * (alpha > 0 ? depth / alpha : 1);
        }
    }

    void finish(DeepSample& cut) const {
        for (int c = 0; c < 3; ++c) {
            cut.alpha[c] = opaque_[c] > 0 ? 1 : -std::expm1(-depth_[c]);
            cut.color[c] =
                opaque_[c] > 0 ? opaque_light_[c] / opaque_[c] : light_[c] * (depth_[c] > 0 ? cut.alpha[c] / depth_[c] : 1);
        }
    }

private:
    glm::dvec3 depth_{0}, light_{0}, opaque_light_{0}, opaque_{0};
};

/// Every depth at which something begins or ends, ascending, each once.
std::vector<double> borders_of(const std::vector<DeepSample>& samples) {
    std::vector<double> borders;
    for (const DeepSample& sample : samples) borders.insert(borders.end(), {sample.depth, sample.back});
    std::ranges::sort(borders);
    borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
    return borders;
}

void count_order(const DeepBlock& block, std::size_t begin, std::size_t end, DeepCensus& census) {
    bool unsorted = false;
    for (std::size_t i = begin + 1; i < end; ++i) {
        unsorted = unsorted || block.depth[i] < block.depth[i - 1];
        if (block.depth[i] == block.depth[i - 1]) ++census.ties;
    }
    if (unsorted) ++census.unsorted_pixels;
}

}  // namespace

bool any_overlap(const std::vector<DeepSample>& samples) {
    double reached = 0;
    for (const DeepSample& sample : samples) {
        if (sample.depth < reached) return true;
        reached = std::max(reached, sample.back);
    }
    return false;
}

std::vector<DeepSample> without_overlaps(const std::vector<DeepSample>& samples) {
    const std::vector<double> borders = borders_of(samples);
    std::vector<MergedCut> cuts(borders.size());
    std::vector<bool> filled(borders.size());
    std::vector<DeepSample> result;
    for (const DeepSample& sample : samples) {
        if (sample.back == sample.depth) {
            result.push_back(sample);
            continue;
        }
        const auto first = std::ranges::lower_bound(borders, sample.depth) - borders.begin();
        for (auto i = static_cast<std::size_t>(first); borders[i] < sample.back; ++i) {
            cuts[i].add(sample, (borders[i + 1] - borders[i]) / (sample.back - sample.depth));
            filled[i] = true;
        }
    }
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        if (!filled[i]) continue;
        DeepSample cut{.depth = borders[i], .back = borders[i + 1]};
        cuts[i].finish(cut);
        result.push_back(cut);
    }
    std::ranges::sort(result, is_nearer);
    return result;
}

Result<void> check_cuts(const DeepCensus& census) {
    if (census.cuts <= most_cuts) return {};
    return fail(Fault::bad_input, "import.deep.overlap",
                "volumes overlap too often: separating them takes up to {cuts} cuts; the limit is {most}", census.cuts,
                most_cuts);
}

Result<std::vector<DeepSample>> pixel_samples(const DeepBlock& block, std::size_t pixel, DeepCensus& census) {
    const std::size_t begin = block.begin[pixel], end = block.begin[pixel + 1];
    std::vector<DeepSample> samples;
    samples.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
        auto sample = usable_sample(block, i, census);
        if (!sample) continue;
        sample->index = static_cast<std::uint32_t>(i - begin);
        samples.push_back(*sample);
    }
    count_order(block, begin, end, census);
    std::ranges::sort(samples, is_nearer);
    if (!any_overlap(samples)) return samples;
    ++census.split_pixels;
    census.cuts += 2 * samples.size() * samples.size();
    if (const auto few = check_cuts(census); !few) return few.error();
    return without_overlaps(samples);
}

glm::dvec4 composite(const std::vector<DeepSample>& nearest_first) {
    glm::dvec3 color(0), through(1);
    for (const DeepSample& sample : nearest_first) {
        color += through * sample.color;
        through *= 1.0 - sample.alpha;
    }
    return {color, 1 - (through.x + through.y + through.z) / 3};
}

}  // namespace strata
