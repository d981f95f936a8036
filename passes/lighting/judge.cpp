#include "passes/lighting/judge.h"

#include "passes/reference/difference.h"
#include "passes/stage_input.h"

namespace strata {

std::vector<Metric> lighting_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    const Difference error = difference(result.at("light"), truth.at("light"));
    return {{"rmse", "radiance", error.rmse}, {"relative rmse", "", error.relative}, {"worst", "radiance", error.worst}};
}

}  // namespace strata
