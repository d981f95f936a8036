// Frames that no artist would send and every technique must survive: tiny, odd, empty, opaque, 200 layers, behind the eye. Where
// a frame must look like a simpler one, it must do so bit for bit.
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "tests/support/agreement.h"
#include "tests/support/every_nth.h"
#include "tests/support/not_finite.h"
#include "tests/support/session.h"

namespace strata {
namespace {

struct HardFrame {
    std::string_view name;
    Frame (*frame)();
    Frame (*looks_like)() = nullptr;  ///< null: held against the models alone
};

Frame scenario(std::string_view name, std::uint32_t width = 0, std::uint32_t height = 0, std::uint32_t samples = 1) {
    const Scenario& found = *must(find_scenario(name));
    return found.build(0, {.width = width ? width : found.width, .height = height ? height : found.height, .samples = samples});
}

/// Glass, smoke, lights and their shadows, and of all draws and emitters nothing.
Frame nothing_in_sight() {
    Frame frame = scenario("glass_and_smoke", 64, 36);
    frame.draws.clear();
    frame.emitters.clear();
    return frame;
}

/// The same with one draw that the eye has its back to, of the first material with such an alpha mode.
Frame behind_the_eye(AlphaMode mode) {
    const Frame whole = scenario("glass_and_smoke", 64, 36);
    Frame frame = nothing_in_sight();
    for (const Draw& draw : whole.draws)
        if (whole.materials[draw.material].alpha_mode == mode && frame.draws.empty()) frame.draws.push_back(draw);
    if (frame.draws.empty()) throw std::runtime_error("the scenario has no such draw");
    const glm::dvec3 forward = glm::transpose(glm::dmat3(frame.view.to_view)) * glm::dvec3(0, 0, 1);
    frame.draws[0].to_world[3] = glm::dvec4(frame.view.origin - 100.0 * forward, 1);
    frame.draws[0].previous_to_world = frame.draws[0].to_world;
    return frame;
}

const HardFrame hard_frames[] = {
    {"one_pixel", [] { return scenario("glass_and_smoke", 1, 1); }},
    {"one_pixel_of_four_samples", [] { return scenario("glass_and_smoke", 1, 1, 4); }},
    {"odd_size_at_four_samples", [] { return scenario("glass_and_smoke", 37, 23, 4); }},
    {"two_hundred_layers", [] { return scenario("two_hundred_layers"); }},
    {"empty", [] { return scenario("empty"); }, [] { return scenario("empty"); }},
    {"all_opaque", [] { return scenario("opaque_only"); }, [] { return scenario("opaque_only"); }},
    {"opaque_behind_the_eye", [] { return behind_the_eye(AlphaMode::opaque); }, nothing_in_sight},
    {"transparent_behind_the_eye", [] { return behind_the_eye(AlphaMode::blend); }, nothing_in_sight},
};

/// Every hard frame, each followed by what it must look like, or by itself.
Session& session_of_hard_frames() {
    static const std::unique_ptr<Session> session = [] {
        std::vector<Frame> frames;
        for (const HardFrame& hard : hard_frames) {
            frames.push_back(hard.frame());
            frames.push_back(hard.looks_like ? hard.looks_like() : hard.frame());
        }
        return session_of(std::move(frames));
    }();
    return *session;
}

/// Frames that one process replays, because the techniques' pipelines are the same for all of them.
struct HardGroup {
    std::vector<HardFrame> frames;
    std::size_t every_nth_technique = 1;
};

void PrintTo(const HardGroup& group, std::ostream* out) { *out << group.frames.front().name; }

class HardFrames : public testing::TestWithParam<HardGroup> {
protected:
    HardFrames() { choose(GetParam().frames.front()); }

    void choose(const HardFrame& chosen) {
        for (const HardFrame& hard : hard_frames)
            if (hard.name == chosen.name) hard_ = 2 * static_cast<std::size_t>(&hard - hard_frames);
        twin_ = hard_ + 1;
    }

    /// Every stage runs, needed or not: the technique meets the frame even where the frame does not call for it. But for later
    /// stages that write over what it wrote: its model does not speak of them.
    Request forced(const Technique& technique) const {
        Request request{
            .variant = {.frame = hard_}, .choices = chosen({std::string(technique.name)}), .outputs = {"color", "display"}};
        for (const std::string_view output : info(technique.stage).outputs)
            if (output != "depth") request.outputs.emplace_back(output);  // multisampled; depth_layers is its copy
        for (const Feature feature : all_features())
            if (may_force(feature, technique)) request.variant.force.push_back(feature);
        return request;
    }

    bool may_force(Feature feature, const Technique& technique) const {
        Features alone;
        alone.set(feature, "forced");
        for (const StageInfo& later : stages())
            for (const std::string_view output : info(technique.stage).outputs)
                if (later.stage > technique.stage && std::ranges::count(later.outputs, output) > 0 && !later.unwanted(alone))
                    return false;
        return feature != Feature::multisampled || must(session_.frame(hard_)).view.samples > 1;
    }

    using Hashes = std::map<std::string, std::string>;  ///< of images by their names

    void expect_numbers_and_what_models_say(const HardFrame&);
    void expect_to_look_like_its_twin(const std::map<std::string_view, Hashes>& hard);

    Session& session_ = session_of_hard_frames();
    std::size_t hard_ = 0, twin_ = 0;
};

/// With every stage forced: what a frame does not call for changes nothing that a model says, and no bit of what its twin shows
/// as needed.
TEST_P(HardFrames, LeaveEveryTechniqueWithNumbersAndWhatItsModelSays) {
    for (const HardFrame& hard : GetParam().frames) {
        SCOPED_TRACE(hard.name);
        choose(hard);
        expect_numbers_and_what_models_say(hard);
    }
}

void HardFrames::expect_numbers_and_what_models_say(const HardFrame& hard) {
    std::map<std::string_view, Hashes> looks;
    const Features called_for = frame_features(must(session_.frame(hard_)));
    for (const Technique& technique : every_nth(GetParam().every_nth_technique, techniques())) {
        const Request request = forced(technique);
        const auto run = session_.run(request);
        ASSERT_TRUE(run) << technique.name << ": " << run.error().sentence;
        EXPECT_TRUE(run->images.contains("display")) << technique.name;
        for (const auto& [name, image] : run->images) {
            EXPECT_EQ(texel_that_is_no_number(image), std::nullopt) << technique.name << " " << name;
            if (hard.looks_like) looks[technique.name].emplace(name, hash_of(image));
        }
        if (info(technique.stage).unwanted(called_for)) continue;
        const auto judged = session_.judge(request, technique.stage, Against::model);
        ASSERT_TRUE(judged) << technique.name << ": " << judged.error().sentence;
        expect_within_tolerance(*judged, technique, request, hard.name);  // some are scenarios
    }
    if (hard.looks_like) expect_to_look_like_its_twin(looks);
}

void HardFrames::expect_to_look_like_its_twin(const std::map<std::string_view, Hashes>& hard) {
    for (const Technique& technique : every_nth(GetParam().every_nth_technique, techniques())) {
        const Request as_needed{
            .variant = {.frame = twin_}, .choices = chosen({std::string(technique.name)}), .outputs = {"color", "display"}};
        const auto plain = must(session_.run(as_needed));
        EXPECT_TRUE(plain.not_counted.empty()) << technique.name;
        for (const auto& [name, image] : plain.images)
            EXPECT_EQ(hash_of(image), hard.at(technique.name).at(name)) << technique.name << " " << name;
    }
}

std::string name_of(const testing::TestParamInfo<HardGroup>& group) {
    const std::vector<HardFrame>& frames = group.param.frames;
    return frames.size() == 1 ? std::string(frames.front().name)
                              : fmt::format("{}_and_{}", frames.front().name, frames.back().name);
}

// One pixel of one sample finds what one of four samples does, where there are no edges, and makes every pipeline for it.
const std::vector<HardFrame> at_four_samples{hard_frames[1], hard_frames[2]};
constexpr std::size_t without_layers = 4;  // from here on
INSTANTIATE_TEST_SUITE_P(FourSamples, HardFrames, testing::Values(HardGroup{at_four_samples, 8}), name_of);
INSTANTIATE_TEST_SUITE_P(Frames, HardFrames,
                         testing::Values(HardGroup{{std::begin(hard_frames) + without_layers, std::end(hard_frames)}}), name_of);
INSTANTIATE_TEST_SUITE_P(Exhaustive, HardFrames,
                         testing::Values(HardGroup{{hard_frames[0]}}, HardGroup{at_four_samples}, HardGroup{{hard_frames[3]}}),
                         name_of);

}  // namespace
}  // namespace strata
