// The stage transparency: what it writes, and when a frame does not need it.
#include <fmt/format.h>

#include "passes/frame_images.h"
#include "passes/scene/scene_facts.h"
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

// Every lit fragment asks all lights (event.glsl), and few techniques have a counter where they draw.
std::optional<std::string> beyond_device(const FrameImages& images) {
    const std::uint64_t turns = images.facts->light_turns();
    constexpr std::uint64_t other_turns = 1024;  // of the material's textures and the technique
    if (turns + other_turns <= most_short_turns || has(images.capabilities, Capability::long_loops)) return std::nullopt;
    if (!images.facts->material_uses(Surfaces::transparent).is_lit()) return std::nullopt;
    return fmt::format(
        "a transparent fragment asks {} lights with their blockers and portals, up to {} turns of a loop, and this device ends "
        "loops after {}",
        images.facts->lights().size(), turns, most_short_turns);
}

}  // namespace

StageInfo stage() {
    return {.purpose = "blends glass, smoke and sparks over the opaque frame",
            .unwanted = unwanted,
            .beyond_device = beyond_device,
            .outputs = {"color"},
            .truth = transparency_truth,
            .judge = transparency_judge,
            .scenarios = {
                "one_pane",         "three_panes",         "interpenetrating_panes", "sixty_layers",     "two_hundred_layers",
                "pane_at_the_lens", "red_and_green_glass", "additive_sparks",        "coincident_panes", "nan_particles",
                "foggy_panes",      "three_cards",         "facade_at_150m",         "tail_light",       "explosion",
                "thin_layers",      "particle_storm",      "interface_layers",       "spheres_125",      "smoke_grenade",
                "glass_and_smoke"}};
}

}  // namespace strata::transparency
