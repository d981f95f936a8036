// Grain and fading of the developed picture.
#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/choice_names.h"
#include "passes/film/grain_and_fade/grain_and_fade.shared.h"
#include "passes/film/grain_and_fade/grain_and_fade_params.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/shaders/hash.shared.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::film {

ImageSet grain_and_fade_model(const StageInput&, const Settings&);

namespace {

constexpr auto forms = choice_names({{grain_centered, "centered"}, {grain_xray, "xray"}, {grain_off, "off"}});

/// The slot of time is found in double and wraps: after hours grain changes as often as at the start (H18).
uint key_of(const Frame& frame, double rate) {
    constexpr double slots = 4294967296.;
    const double slot = std::floor(frame.time * rate), wrapped = slot - std::floor(slot / slots) * slots;
    return hashed(static_cast<uint>(frame.seed), uvec3(static_cast<uint>(std::isfinite(wrapped) ? wrapped : 0), 0, 0));
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<GrainParams>();
    const Frame& recorded = *frame.recorded;
    graph.compute("film/grain_and_fade/grain.comp")
        .updates("display", frame.display)
        .fixes("form", recorded.film.grain > 0 ? params.grain : grain_off)
        .push(GrainPush{.key = key_of(recorded, double(params.grain_rate)),
                        .amount = recorded.film.grain,
                        .fade = std::clamp(recorded.film.fade, 0.f, 1.f)})
        .over(frame.extent);
}

}  // namespace

Technique grain_and_fade() {
    return {
        .stage = Stage::film,
        .name = "film/grain_and_fade",
        .title = "Grain and fading",
        .source = "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, GDC 2009",
        .summary =
            "Multiplies display light by noise that is redrawn at a fixed rate, then fades to black; grain follows the "
            "picture's pixels, so that it is finer at a higher resolution.",
        .params = {param<&GrainParams::grain>({.name = "grain",
                                               .fallback = grain_centered,
                                               .help = "noise: centered on 1, X-Ray's bytes centered on 128, or none",
                                               .choices = forms}),
                   param<&GrainParams::grain_rate>({.name = "grain_rate",
                                                    .low = 1,
                                                    .high = 240,
                                                    .fallback = 24,
                                                    .help = "times per second that grain is redrawn",
                                                    .scale = Scale::logarithmic})},
        .variants = {"grain=xray", "grain=off", "grain_rate=60"},
        .abilities = {.is_time_unit = true},
        .declare = declare,
        .model = grain_and_fade_model,
        .tolerance = {.rmse = 1e-3, .worst = 2e-3, .because = "display light is stored as half floats of undefined rounding"}};
}

}  // namespace strata::film
