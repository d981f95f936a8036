#include "passes/film/judge.h"

#include <cmath>

#include "passes/reference/difference.h"
#include "passes/reference/display_light.h"
#include "passes/stage_input.h"

namespace strata {

std::vector<Metric> film_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    const ReferenceImage &got = result.at("display"), &wanted = truth.at("display");
    const DisplayError error = display_error(got, wanted);
    return {{display_rmse, "of white", error.rmse},
            {"display worst", "of white", error.worst},
            {"brightness error", "of white", std::abs(difference(got, wanted).bias)}};
}

}  // namespace strata
