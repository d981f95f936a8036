// Frames of one layer of one kind of fragment: what a technique makes of a plain pane it makes of the others, or says that it
// cannot.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame_features.h"
#include "captures/cards.h"
#include "passes/registry.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/truth.h"

namespace strata::transparency {
namespace {

constexpr std::uint32_t extent = 8;

struct Kind {
    std::string_view name;
    Frame frame;
};

Frame pane(glm::vec4 color, AlphaMode alpha_mode = AlphaMode::blend, glm::vec3 transmission = glm::vec3(0)) {
    Frame frame = frame_of_cards(std::array{Card{.center = {0, 0, 2}, .color = color, .alpha_mode = alpha_mode}}, extent);
    frame.materials[0].transmission = transmission;
    return frame;
}

Frame plain_pane() { return pane({.8f, .4f, .2f, .5f}); }

Frame glowing_particle(float alpha) {
    Frame frame = frame_of_cards({}, extent);
    frame.emitters.push_back({.name = "spark", .particles = {{.center = {0, 0, 2}, .size = 8, .color = {.8f, .4f, .2f}}}});
    frame.emitters[0].particles[0].alpha = alpha;
    frame.emitters[0].particles[0].emissive = {.3f, .2f, .1f};
    return frame;
}

std::vector<Kind> kinds() {
    std::vector<Kind> all{{"neutral transmission", pane({.02f, .02f, .02f, 1}, AlphaMode::blend, glm::vec3(.96f))},
                          {"dark neutral transmission", pane({.1f, .1f, .1f, 1}, AlphaMode::blend, glm::vec3(.5f))},
                          {"colored transmission", pane({.1f, .1f, .1f, 1}, AlphaMode::blend, {.9f, .5f, .1f})},
                          {"additive", pane({.3f, .2f, .1f, 1}, AlphaMode::additive)},
                          {"premultiplied", pane({.4f, .2f, .1f, .5f}, AlphaMode::premultiplied)},
                          {"premultiplied emission", pane({.8f, .4f, .2f, .25f}, AlphaMode::premultiplied)},
                          {"premultiplied emission without coverage", pane({.3f, .2f, .1f, 0}, AlphaMode::premultiplied)},
                          {"a particle that emits", glowing_particle(.5f)},
                          {"a particle that emits without coverage", glowing_particle(0)},
                          {"low resolution", plain_pane()},
                          {"interface layer", plain_pane()}};
    all[all.size() - 2].frame.draws[0].resolution = Resolution::low;
    all.back().frame.draws[0].layer = 1;
    return all;
}

/// Largest difference from the truth relative to max(1, the truth), over a gray background.
double error_of(const Technique& technique, const Frame& frame) {
    const ImageSet before{{"color", ReferenceImage(extent, extent, 1, glm::dvec4(.5, .5, .5, 1))}};
    const StageInput input{frame, before};
    const ReferenceImage made = technique.model(input, Settings(technique.params)).at("color");
    const ReferenceImage truth = transparency_truth(input).at("color");
    double most = 0;
    for (std::size_t i = 0; i < made.texels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            most = std::max(most, std::abs(made.texels[i][c] - truth.texels[i][c]) / std::max(1.0, truth.texels[i][c]));
    return most;
}

/// What a technique's README says of one layer of a kind: its approximation, and not a kind that it cannot do.
struct Explained {
    std::string_view technique, kind;
    double error;
};

constexpr Explained explained[] = {
    {"transparency/weighted", "colored transmission", 0.08},
    {"transparency/stochastic", "colored transmission", 0.08},
    {"transparency/moments", "a particle that emits", 0.0477},
    {"transparency/weighted_additive", "premultiplied emission without coverage", 0.3},
    {"transparency/weighted_additive", "a particle that emits", 0.4385},
};

double explained_error(const Technique& technique, std::string_view kind) {
    const auto found = std::ranges::find_if(
        explained, [&](const Explained& row) { return row.technique == technique.name && row.kind == kind; });
    return found == std::end(explained) ? 0 : found->error;
}

class FragmentKinds : public testing::TestWithParam<const Technique*> {};

TEST_P(FragmentKinds, AreDoneAsAPlainPaneIsOrRefused) {
    const Technique& technique = *GetParam();
    const double plain = error_of(technique, plain_pane());
    EXPECT_LT(plain, 0.003) << "codes of eight bits and less";
    for (const Kind& kind : kinds()) {
        SCOPED_TRACE(kind.name);
        const double error = error_of(technique, kind.frame), at_most = 2 * plain + 3e-4;
        if (const double known = explained_error(technique, kind.name); known > 0) {
            EXPECT_NEAR(error, known, 0.02 * known);
        } else if (unsupported(technique, frame_features(kind.frame))) {
            EXPECT_GT(error, 0.05) << "it can, and says that it cannot";
        } else {
            EXPECT_LE(error, at_most) << "it cannot, and does not say so";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Techniques, FragmentKinds, testing::ValuesIn(techniques_of(Stage::transparency)),
                         [](const auto& tested) {
                             return std::string(tested.param->name.substr(tested.param->name.find('/') + 1));
                         });

}  // namespace
}  // namespace strata::transparency
