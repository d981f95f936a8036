// The step function in double.
#include "passes/technique.h"
#include "passes/transparency/exact_function/exact_function.shared.h"
#include "passes/transparency/function_model.h"

namespace strata::transparency {
namespace {

Transmittance step_function(std::span<const Fragment> fragments) {
    return [fragments](const Fragment& at) {
        glm::dvec3 through(1);
        for (const Fragment& fragment : fragments)
            if (fragment.depth < at.depth) through *= fragment.transmittance;
        return through;
    };
}

}  // namespace

ImageSet exact_function_model(const StageInput& input, const Settings& settings) {
    return function_model(input, settings.as<ExactFunctionParams>().accumulation, step_function);
}

}  // namespace strata::transparency
