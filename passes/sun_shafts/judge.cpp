#include "passes/sun_shafts/judge.h"

#include <cmath>
#include <cstddef>

#include "passes/reference/difference.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

/// Over the colors of the texels that difference() compares.
double mean(const ReferenceImage& got, const ReferenceImage& wanted) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        if (!decided(got, wanted, i)) continue;
        const glm::dvec4& texel = wanted.texels[i];
        sum += (texel.x + texel.y + texel.z) / 3;
        ++count;
    }
    return count > 0 ? sum / double(count) : 0;
}

}  // namespace

std::vector<Metric> sun_shafts_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    const ReferenceImage &got = result.at("shafts"), &wanted = truth.at("shafts");
    const Difference error = difference(got, wanted);
    const double whole = mean(got, wanted);
    return {{"relative rmse", "", error.relative},
            {"rmse", "radiance", error.rmse},
            {"worst", "radiance", error.worst},
            {"relative bias", "",
             std::isnan(error.bias) ? HUGE_VAL
             : whole > 0            ? error.bias / whole
                                    : error.bias}};
}

}  // namespace strata
