#include "passes/transparency/judge.h"

#include <algorithm>
#include <cmath>

#include "passes/reference/difference.h"

namespace strata {
namespace {

/// What `display` makes of a radiance: x (1 + x / Wt^2) / (1 + x) after exposure, at most 1.
double displayed(const Frame& frame, double radiance) {
    const double x = std::max(0., radiance * double(frame.view.exposure)), white = double(frame.film.white);
    return std::min(1., x * (1 + x / (white * white)) / (1 + x));
}

bool off_by_a_step(const Frame& frame, const glm::dvec4& got, const glm::dvec4& wanted) {
    for (int c = 0; c < 3; ++c)
        if (std::abs(displayed(frame, got[c]) - displayed(frame, wanted[c])) > 1. / 255) return true;
    return false;
}

}  // namespace

std::vector<Figure> transparency_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const ReferenceImage &got = result.at("color"), &wanted = truth.at("color");
    const Difference error = difference(got, wanted);
    std::size_t off = 0;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i)
        if (decided(got, wanted, i) && off_by_a_step(input.frame, got.texels[i], wanted.texels[i])) ++off;
    return {
        {"rmse", "radiance", error.rmse},
        {"relative rmse", "", error.relative},
        {"worst", "radiance", error.worst},
        {"bias", "radiance", error.bias},
        {"off by 1/255", "%", 100 * double(off) / double(std::max<std::size_t>(1, error.compared))},
    };
}

}  // namespace strata
