#include "passes/combine/judge.h"

#include <algorithm>
#include <cmath>

namespace strata {
namespace {

struct Errors {
    double rmse = 0, relative = 0, worst = 0;
};

Errors errors_of(const ReferenceImage& got, const ReferenceImage& wanted) {
    double error_sum = 0, truth_sum = 0, worst = 0;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        const glm::dvec3 right(wanted.texels[i]), error = glm::abs(glm::dvec3(got.texels[i]) - right);
        error_sum += glm::dot(error, error);
        truth_sum += glm::dot(right, right);
        worst = std::max({worst, error.x, error.y, error.z});
    }
    const double values = std::max(1.0, 3.0 * double(wanted.texels.size()));
    return {std::sqrt(error_sum / values), truth_sum > 0 ? std::sqrt(error_sum / truth_sum) : std::sqrt(error_sum), worst};
}

}  // namespace

std::vector<Figure> combine_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    std::vector<Figure> figures;
    if (const auto display = result.find("display"); display != result.end()) {
        const Errors errors = errors_of(display->second, truth.at("display"));
        figures = {{"display rmse", "of white", errors.rmse}, {"display worst", "of white", errors.worst}};
    }
    const auto color = truth.find("color");
    if (color != truth.end() && result.contains("color"))
        figures.push_back({"radiance relative rmse", "", errors_of(result.at("color"), color->second).relative});
    return figures;
}

}  // namespace strata
