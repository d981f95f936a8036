// The mean of the samples in double, where sums of four half floats or of four bytes have no rounding to speak of.
#include <algorithm>
#include <vector>

#include "passes/edges/mean/mean.shared.h"
#include "passes/edges/mean/mean_params.h"
#include "passes/edges/surface_tests_model.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::edges {
namespace {

bool mean_differs(const ReferenceImage& image, std::uint32_t x, std::uint32_t y) {
    glm::dvec4 sum(0);
    for (std::uint32_t sample = 0; sample < image.layers; ++sample) sum += image.at(x, y, sample);
    return sum / double(image.layers) != image.at(x, y, 0);
}

}  // namespace

ImageSet mean_model(const StageInput& input, const Settings& settings) {
    std::vector<std::string_view> names{"gbuffer0"};
    if (settings.as<MeanParams>().compares == compares_all) names = {"gbuffer0", "gbuffer1", "gbuffer2", "emission"};
    return marked(input, [&](std::uint32_t x, std::uint32_t y) {
        return verdict_of(std::ranges::any_of(names, [&](std::string_view name) {
            const auto image = input.before.find(name);
            return image != input.before.end() && mean_differs(image->second, x, y);
        }));
    });
}

}  // namespace strata::edges
