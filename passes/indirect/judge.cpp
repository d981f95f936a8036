#include "passes/indirect/judge.h"

#include <cmath>

#include "passes/reference/difference.h"

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

double leak(const ReferenceImage& got, const ReferenceImage& wanted) {
    Mean dark, bright;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        const glm::dvec4& truth = wanted.texels[i];
        const bool is_surface = truth.w > 0;
        if (!is_surface || !decided(got, wanted, i)) continue;
        if (glm::dvec3(truth) == glm::dvec3(0)) dark.add(got.texels[i]);
        else bright.add(truth);
    }
    // Where the truth is black everywhere there is nothing to be relative to.
    return dark.value() / (bright.value() > 0 ? bright.value() : 1);
}

}  // namespace

std::vector<Figure> indirect_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    const ReferenceImage &got = result.at("indirect"), &wanted = truth.at("indirect");
    const Difference error = difference(got, wanted);
    return {{"rmse", "radiance", error.rmse},
            {"relative rmse", "", error.relative},
            {"worst", "radiance", error.worst},
            {"leak", "", leak(got, wanted)}};
}

}  // namespace strata
