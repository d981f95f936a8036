// The stage transparency: what it writes, and when a frame does not need it.
#include "passes/stages.h"
#include "passes/transparency/judge.h"
#include "passes/transparency/truth.h"

namespace strata::transparency {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::transparent) || features.has(Feature::additive) || features.has(Feature::particles))
        return std::nullopt;
    return "the frame has no transparent draws or particles";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "blends glass, smoke and sparks over the opaque frame",
            .unwanted = unwanted,
            .outputs = {"color"},
            .truth = transparency_truth,
            .judge = transparency_judge,
            .scenarios = {
                "one_pane",         "three_panes",         "interpenetrating_panes", "sixty_layers",     "two_hundred_layers",
                "pane_at_the_lens", "red_and_green_glass", "additive_sparks",        "coincident_panes", "nan_particles",
                "foggy_panes",      "three_cards",         "facade_at_150m",         "tail_light",       "explosion",
                "thin_layers",      "particle_storm",      "interface_layers",       "smoke_grenade",    "glass_and_smoke"}};
}

}  // namespace strata::transparency
