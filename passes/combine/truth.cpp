#include "passes/combine/truth.h"

#include "capture_format/frame/frame.h"
#include "passes/combine/formulas.h"
#include "passes/stage_input.h"

namespace strata {

ImageSet combine_truth(const StageInput& input) {
    const View& view = input.frame.view;
    ReferenceImage color(view.width, view.height, view.samples), display(view.width, view.height);
    const combine::Look look = combine::recorded_look(input.frame);
    for (std::uint32_t sample = 0; sample < view.samples; ++sample)
        for (std::uint32_t y = 0; y < view.height; ++y)
            for (std::uint32_t x = 0; x < view.width; ++x)
                color.at(x, y, sample) = glm::dvec4(combine::composed(input, {x, y, sample}, look), 1);
    // What was drawn over the combined color is given: it is another stage's to judge.
    const bool drawn_over = combine::is_drawn_over(input.frame);
    const ReferenceImage& final_color = drawn_over ? input.before.at("color") : color;
    for (std::uint32_t y = 0; y < view.height; ++y)
        for (std::uint32_t x = 0; x < view.width; ++x)
            display.at(x, y) = glm::dvec4(combine::developed(input, final_color, x, y), 1);
    ImageSet images{{"display", display}};
    if (!drawn_over) images.emplace("color", color);
    return images;
}

}  // namespace strata
