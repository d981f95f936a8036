#include "passes/combine/judge.h"

#include "passes/reference/difference.h"

namespace strata {

std::vector<Figure> combine_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    std::vector<Figure> figures;
    if (const auto display = result.find("display"); display != result.end()) {
        const Difference error = difference(display->second, truth.at("display"));
        figures = {{"display rmse", "of white", error.rmse}, {"display worst", "of white", error.worst}};
    }
    const auto color = truth.find("color");
    if (color != truth.end() && result.contains("color"))
        figures.push_back({"radiance relative rmse", "", difference(result.at("color"), color->second).relative});
    return figures;
}

}  // namespace strata
