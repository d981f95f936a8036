#include "passes/combine/judge.h"

#include "passes/reference/difference.h"
#include "passes/reference/display_light.h"
#include "passes/stage_input.h"

namespace strata {

std::vector<Metric> combine_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    std::vector<Metric> metrics;
    if (const auto display = result.find("display"); display != result.end()) {
        const DisplayError error = display_error(display->second, truth.at("display"));
        metrics = {{display_rmse, "of white", error.rmse}, {"display worst", "of white", error.worst}};
    }
    const auto color = truth.find("color");
    if (color != truth.end() && result.contains("color"))
        metrics.push_back({"radiance relative rmse", "", difference(result.at("color"), color->second).relative});
    return metrics;
}

}  // namespace strata
