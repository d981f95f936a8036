#include "passes/lighting/judge.h"

#include <algorithm>
#include <cmath>

namespace strata {

std::vector<Figure> lighting_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    const ReferenceImage &got = result.at("light"), &wanted = truth.at("light");
    double error_sum = 0, truth_sum = 0, worst = 0;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        const glm::dvec3 right(wanted.texels[i]), error = glm::abs(glm::dvec3(got.texels[i]) - right);
        error_sum += glm::dot(error, error);
        truth_sum += glm::dot(right, right);
        worst = std::max({worst, error.x, error.y, error.z});
    }
    const double values = std::max(1.0, 3.0 * double(wanted.texels.size()));
    const double relative = truth_sum > 0 ? std::sqrt(error_sum / truth_sum) : std::sqrt(error_sum);
    return {{"rmse", "radiance", std::sqrt(error_sum / values)}, {"relative rmse", "", relative}, {"worst", "radiance", worst}};
}

}  // namespace strata
