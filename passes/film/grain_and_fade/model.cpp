// The same in double. Noise is a bit pattern, so the model repeats the shader's: grain_and_fade_test.cpp tests what it must be.
#include <cmath>

#include "passes/film/grain_and_fade/grain_and_fade.shared.h"
#include "passes/film/grain_and_fade/grain_and_fade_params.h"
#include "passes/film/grain_model.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::film {

ImageSet grain_and_fade_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<GrainParams>();
    ReferenceImage display = input.before.at("display");
    for (std::uint32_t y = 0; y < display.height; ++y)
        for (std::uint32_t x = 0; x < display.width; ++x) {
            double noise = (grain_rank(input.frame, x, y, double(params.grain_rate)) + .5) / 4096;
            if (params.grain == grain_xray) noise = (1 + std::floor(255 * noise)) / 255;
            if (params.grain == grain_off) noise = .5;
            display.at(x, y) = aged(input.frame, display.at(x, y), noise);
        }
    return {{"display", std::move(display)}};
}

}  // namespace strata::film
