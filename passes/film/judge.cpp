#include "passes/film/judge.h"

#include <cmath>

#include "passes/reference/difference.h"
#include "passes/stage_input.h"

namespace strata {

std::vector<Metric> film_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    const Difference error = difference(result.at("display"), truth.at("display"));
    return {{"display rmse", "of white", error.rmse},
            {"display worst", "of white", error.worst},
            {"brightness error", "of white", std::abs(error.bias)}};
}

}  // namespace strata
