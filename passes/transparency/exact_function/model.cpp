// The step function in double.
#include "passes/transparency/functions/model.h"
#include "passes/technique.h"
#include "passes/transparency/exact_function/exact_function.shared.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {
namespace {

Transmittance step_function(std::span<const Fragment> fragments) {
    return [fragments](const Fragment& at) { return transmittance_before(fragments, at.depth); };
}

}  // namespace

ImageSet exact_function_model(const StageInput& input, const Settings& settings) {
    return function_model(input, settings.as<ExactFunctionParams>().accumulation, step_function);
}

}  // namespace strata::transparency
