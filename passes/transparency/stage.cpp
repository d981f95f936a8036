// The stage transparency: what it writes, and when a frame does not need it.
#include "capture_format/frame/light.h"
#include "capture_format/result.h"
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

// Every lit fragment asks all lights (fragment.glsl), and few techniques have a counter where they draw.
std::optional<Error> beyond_device(const FrameImages& images) {
    const std::uint64_t iterations = images.facts->light_iterations();
    constexpr std::uint64_t other_iterations = 1024;  // of the material's textures and the technique
    if (iterations + other_iterations <= most_short_iterations || has(images.capabilities, Capability::long_loops))
        return std::nullopt;
    if (!images.facts->material_uses(Surfaces::transparent).is_lit()) return std::nullopt;
    return fail(
        Fault::device_lacks, "device.short_loops",
        "a transparent fragment tests {lights} lights with their blockers and portals in up to {iterations} loop iterations, and "
        "this device ends loops after {limit}",
        images.facts->lights().size(), iterations, most_short_iterations);
}

}  // namespace

StageInfo stage() {
    return {.purpose = "blends glass, smoke and sparks over the opaque frame",
            .aliases = {"oit"},
            .unwanted = unwanted,
            .beyond_device = beyond_device,
            .outputs = {"color"},
            .truth = transparency_truth,
            .judge = transparency_judge,
            .settle = settle_transparency,
            .scenarios = {
                "one_pane",         "three_panes",         "interpenetrating_panes", "sixty_layers",     "two_hundred_layers",
                "pane_at_the_lens", "red_and_green_glass", "additive_sparks",        "coincident_panes", "nan_particles",
                "foggy_panes",      "three_cards",         "facade_at_150m",         "tail_light",       "explosion",
                "thin_layers",      "particle_storm",      "interface_layers",       "spheres_125",      "smoke_grenade",
                "glass_and_smoke"}};
}

}  // namespace strata::transparency
