#include "passes/indirect/judge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "passes/reference/difference.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

/// The mean over texels that were added.
struct Mean {
    double sum = 0, count = 0;
    void add(const glm::dvec4& texel) {
        // NaN counts as infinite.
        for (int c = 0; c < 3; ++c) sum += std::isnan(texel[c]) ? HUGE_VAL : std::abs(texel[c]);
        count += 3;
    }
    double value() const { return count > 0 ? sum / count : 0; }
};

/// Whether the truth is black at all of a pixel's samples that show a surface. A single black sample at an edge is no dark room:
/// its place, decoded, lies inside the edge.
bool is_dark(const ReferenceImage& truth, std::uint32_t x, std::uint32_t y) {
    for (std::uint32_t sample = 0; sample < truth.layers; ++sample) {
        const glm::dvec4& light = truth.at(x, y, sample);
        if (light.w > 0 && glm::dvec3(light) != glm::dvec3(0)) return false;
    }
    return true;
}

struct Leak {
    double light = 0;  ///< mean over dark pixels, relative to the truth's elsewhere
    double dark = 0;   ///< share of all samples with a surface that this mean is over
};

Leak leak(const ReferenceImage& got, const ReferenceImage& wanted) {
    Mean dark, bright;
    for (std::uint32_t y = 0; y < wanted.height; ++y)
        for (std::uint32_t x = 0; x < wanted.width; ++x) {
            const bool all_dark = is_dark(wanted, x, y);
            for (std::uint32_t sample = 0; sample < wanted.layers; ++sample) {
                const std::size_t i = wanted.index(x, y, sample);
                if (wanted.texels[i].w <= 0 || !decided(got, wanted, i)) continue;
                if (all_dark) dark.add(got.texels[i]);
                else bright.add(wanted.texels[i]);
            }
        }
    // Where the truth is black everywhere there is nothing to be relative to.
    return {dark.value() / (bright.value() > 0 ? bright.value() : 1), dark.count / std::max(dark.count + bright.count, 1.0)};
}

}  // namespace

std::vector<Metric> indirect_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    const ReferenceImage &got = result.at("indirect"), &wanted = truth.at("indirect");
    const Difference error = difference(got, wanted);
    const Leak leaked = leak(got, wanted);
    return {{"rmse", "radiance", error.rmse},
            {"relative rmse", "", error.relative},
            {"worst", "radiance", error.worst},
            {"leak", "", leaked.light},
            {"dark", "%", 100 * leaked.dark}};
}

}  // namespace strata
