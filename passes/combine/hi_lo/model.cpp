// The same in double. What is developed is the color that the last act found, with everything drawn over it.
#include "passes/combine/formulas.h"
#include "passes/edges/plain_pixels.h"
#include "passes/technique.h"

namespace strata::combine {
namespace {

ReferenceImage combined(const StageInput& input) {
    const View& view = input.frame.view;
    ReferenceImage color(view.width, view.height, view.samples);
    for (std::uint32_t sample = 0; sample < view.samples; ++sample)
        for (std::uint32_t y = 0; y < view.height; ++y)
            for (std::uint32_t x = 0; x < view.width; ++x) {
                const std::uint32_t shaded = is_plain_pixel(input, x, y) ? 0 : sample;
                color.at(x, y, sample) = glm::dvec4(composed(input, {x, y, sample, shaded}), 1);
            }
    return color;
}

}  // namespace

ImageSet hi_lo_model(const StageInput& input, const Settings&) {
    const View& view = input.frame.view;
    ReferenceImage display(view.width, view.height);
    const ReferenceImage& found = input.before.at("color");
    for (std::uint32_t y = 0; y < view.height; ++y)
        for (std::uint32_t x = 0; x < view.width; ++x) display.at(x, y) = glm::dvec4(developed(input.frame, found, x, y), 1);
    ImageSet images{{"display", display}};
    if (!is_drawn_over(input.frame)) images.emplace("color", combined(input));
    return images;
}

}  // namespace strata::combine
