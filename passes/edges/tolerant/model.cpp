// The tests of decoded surfaces in double.
#include "passes/edges/edges.shared.h"
#include "passes/edges/surface_tests_model.h"
#include "passes/edges/tolerant/tolerant_params.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::edges {

ImageSet tolerant_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<TolerantParams>();
    const ModelLimits limits{.normal_angle = params.normal_angle,
                             .depth_step = params.depth_step,
                             .color_step = params.color_step,
                             .tests = test_normal | test_depth | test_material};
    return marked(input, [&](std::uint32_t x, std::uint32_t y) { return surface_verdict(input, x, y, limits); });
}

}  // namespace strata::edges
