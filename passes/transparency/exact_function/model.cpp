// The step function in double.
#include <algorithm>

#include "passes/settings.h"
#include "passes/stage_input.h"
#include "passes/transparency/exact_function/exact_function_params.h"
#include "passes/transparency/functions/model.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {
namespace {

Transmittance step_function(std::span<const Fragment> fragments) {
    std::vector<Fragment> sorted = nearest_first(fragments);
    std::vector<glm::dvec3> behind{glm::dvec3(1)};
    for (const Fragment& fragment : sorted) behind.push_back(behind.back() * fragment.transmittance);
    return [sorted = std::move(sorted), behind = std::move(behind)](const Fragment& at) {
        const auto first_not_nearer = std::ranges::lower_bound(sorted, at.depth, {}, &Fragment::depth);
        return behind[static_cast<std::size_t>(first_not_nearer - sorted.begin())];
    };
}

}  // namespace

ImageSet exact_function_model(const StageInput& input, const Settings& settings) {
    return function_model(input, settings.as<ExactFunctionParams>().accumulation, step_function);
}

}  // namespace strata::transparency
