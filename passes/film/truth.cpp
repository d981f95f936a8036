#include "passes/film/truth.h"

#include "passes/film/grain_model.h"
#include "passes/stage_input.h"

namespace strata {

ImageSet film_truth(const StageInput& input) {
    constexpr double rate = 24, values = 4096;
    ReferenceImage display = input.before.at("display");
    for (std::uint32_t y = 0; y < display.height; ++y)
        for (std::uint32_t x = 0; x < display.width; ++x) {
            const double noise = (film::grain_rank(input.frame, x, y, rate) + .5) / values;
            display.at(x, y) = film::aged(input.frame, display.at(x, y), noise);
        }
    return {{"display", std::move(display)}};
}

}  // namespace strata
