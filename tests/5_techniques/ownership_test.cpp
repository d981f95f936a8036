// A technique writes only the frame's images that its stage owns (StageInfo::outputs). Found from the declared steps; needs no
// device.
#include <algorithm>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/scenarios.h"
#include "passes/graph/graph.h"
#include "passes/registry.h"
#include "passes/scene/scene_facts.h"
#include "passes/stages.h"
#include "replay/session/frame_plan.h"
#include "tests/support/print.h"
#include "tests/support/session.h"
#include "ui/replayer/step_work.h"

namespace strata {
namespace {

/// A declared frame whose scene is nothing but names: enough to see who writes what.
struct Sketch {
    Frame recorded;
    std::optional<SceneFacts> facts;  ///< of `recorded`
    Features features;
    Graph graph;
    FrameImages images;
    DeclaredFrame frame;
};

/// Commands and indices that no device ever sees.
DrawList draws_of(Graph& graph, std::uint64_t key, std::size_t count) {
    return {graph.import("commands", 20 * std::max<std::size_t>(count, 1), ImportId{key}),
            graph.import("indices", 4, ImportId{1}), 0, static_cast<std::uint32_t>(count)};
}

void sketch(Sketch& s, const Technique& technique, std::string_view scenario, std::uint32_t samples) {
    s.recorded = scenario_frames(scenario, samples).front();
    for (const Feature feature : all_features()) s.features.set(feature, "every stage is wanted here");
    s.images = {.recorded = &s.recorded,
                .features = &s.features,
                .facts = &s.facts.emplace(s.recorded),
                .extent = {s.recorded.view.width, s.recorded.view.height, 1},
                .samples = samples};
    s.images.all_opaque = s.images.opaque = draws_of(s.graph, 2, s.facts->lists().opaque.size());
    s.images.casters = draws_of(s.graph, 3, s.facts->lists().opaque.size());
    s.images.transparent = draws_of(s.graph, 4, s.facts->lists().transparent.size());
    s.images.back_to_front = draws_of(s.graph, 5, s.facts->lists().transparent.size());
    Choices choices = must(choose(s.recorded));
    choices[technique.stage] = {&technique, Settings(technique.params)};
    Capabilities every;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(Capability::count_); ++i)
        every.push_back(static_cast<Capability>(i));
    s.frame = must(declare_frame(s.graph, s.images, choices, every));
}

/// "depth in gbuffer/x/fill" for everything the technique's passes write or replace that its stage does not own.
std::vector<std::string> trespasses(const Sketch& s, const Technique& technique) {
    std::vector<std::string> found;
    const std::vector<std::string_view>& owned = info(technique.stage).outputs;
    for (std::size_t i = 0; i < s.frame.passes.size(); ++i) {
        const DeclaredPass& pass = s.frame.passes[i];
        if (pass.technique != &technique) continue;
        const FrameImages& after = i + 1 < s.frame.passes.size() ? s.frame.passes[i + 1].before : s.images;
        for (const FrameImageRow& row : frame_images()) {
            if (std::ranges::count(owned, row.name)) continue;
            const Image before = pass.before.*row.member;
            if ((after.*row.member).id != before.id) found.push_back(fmt::format("{} is replaced", row.name));
            for (const Step& step : s.graph.steps())
                if (step.scope == pass.scope && before && std::ranges::count(images_written(step), before.id, &Image::id) > 0)
                    found.push_back(fmt::format("{} in {}", row.name, step.name));
        }
    }
    return found;
}

bool passes(const Sketch& s, const Technique& technique) {
    return std::ranges::count(s.frame.passes, &technique, &DeclaredPass::technique) > 0;
}

class Ownership : public testing::TestWithParam<Technique> {};

TEST_P(Ownership, ATechniqueWritesOnlyWhatItsStageOwns) {
    const Technique& technique = *must(find_technique(GetParam().name));
    for (const std::string_view scenario : info(technique.stage).scenarios)
        for (const std::uint32_t samples : {1u, 4u}) {
            Sketch s;
            sketch(s, technique, scenario, samples);
            EXPECT_TRUE(passes(s, technique));
            EXPECT_THAT(trespasses(s, technique), testing::IsEmpty()) << scenario << " at " << samples;
        }
}

INSTANTIATE_TEST_SUITE_P(Techniques, Ownership, testing::ValuesIn(techniques().begin(), techniques().end()), technique_test_name);

TEST(Trespassing, IsSeenInStepsAndInHandles) {
    const auto trespass = [](Graph& graph, FrameImages& frame, const Settings&) {
        graph.clear(frame.light, {});
        frame.depth_layers = graph.create("my own depth", {.extent = frame.extent, .format = Format::r32f});
    };
    const Technique technique{.stage = Stage::transparency, .name = "transparency/trespasser", .declare = trespass};
    Sketch s;
    sketch(s, technique, "glass_and_smoke", 1);
    EXPECT_THAT(trespasses(s, technique), testing::UnorderedElementsAre("light in clear light", "depth_layers is replaced"));
}

TEST(EveryFrameImage, IsOwnedByAStage) {
    for (const FrameImageRow& row : frame_images()) {
        const auto owns = [&](const StageInfo& stage) { return std::ranges::count(stage.outputs, row.name) > 0; };
        EXPECT_TRUE(std::ranges::any_of(stages(), owns)) << row.name;
    }
}

}  // namespace
}  // namespace strata
