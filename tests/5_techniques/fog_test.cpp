// Fog on opaque surfaces at every setting of combining, on the device.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/support/agreement.h"
#include "tests/support/endless_ground.h"

namespace strata {
namespace {

/// Seen by a wide lens.
Frame foggy_ground(float density, FogPath path, std::uint32_t samples = 1) {
    Frame frame =
        endless_ground({.eye = {0, 1.7, 0}, .target = {2, 1.2, -4}, .vertical_fov = 1.18f, .width = 64, .height = 36}, samples);
    frame.background = {.2f, .3f, .6f};
    frame.fog = {.density = density, .color = {.6f, .5f, .4f}, .path = path};
    return frame;
}

const std::vector<std::vector<std::string>>& fog_settings() {
    static const std::vector<std::vector<std::string>> all = {
        {},
        {"fog_distance=distance"},
        {"fog_distance=view_depth"},
        {"fog_sky=blended"},
        {"fog_sky=blended", "fog_distance=distance"},
        {"fog=linear"},
        {"fog=linear", "fog_distance=distance", "fog_near=.5", "fog_far=3"},
        {"fog=linear", "fog_sky=blended", "fog_near=.2"},
        {"fog=linear", "fog_sky=blended", "fog_distance=distance", "fog_far=.7"}};
    return all;
}

}  // namespace

TEST(Fog, AtEverySettingIsWhatTheModelSays) {
    const Technique& technique = *must(find_technique("combine/hi_lo"));
    const std::pair<std::uint32_t, FogPath> frames[] = {{1, FogPath::view_depth}, {1, FogPath::distance}, {4, FogPath::distance}};
    for (const auto& [samples, path] : frames) {
        const auto session = session_of(std::vector<Frame>{foggy_ground(.15f, path, samples)});
        for (const std::vector<std::string>& sets : fog_settings()) {
            if (samples > 1 && sets.size() < 4) continue;  // one of many parameters is enough there
            SCOPED_TRACE(testing::PrintToString(sets));
            const Request request{.choices = chosen({}, sets)};
            const Accuracy accuracy = must(session->judge(request, Stage::combine, Against::model));
            expect_within_tolerance(accuracy, technique, request);
            EXPECT_GE(accuracy.compared - accuracy.trivial, 1000u);
        }
    }
}

/// Radiance relative to the truth.
double fog_error(Session& session, const std::vector<std::string>& sets) {
    const Accuracy accuracy = must(session.judge({.choices = chosen({}, sets)}, Stage::combine, Against::truth));
    return accuracy.technique_errors.at(2).value;
}

TEST(Fog, IsExactAlongTheRecordedPathAloneAndARampIsNot) {
    const auto session = session_of(std::vector<Frame>{foggy_ground(.15f, FogPath::view_depth)});
    EXPECT_LT(fog_error(*session, {}), 1e-5);
    EXPECT_LT(fog_error(*session, {"fog_distance=view_depth"}), 1e-5);
    EXPECT_GT(fog_error(*session, {"fog_distance=distance"}), .01);
    EXPECT_GT(fog_error(*session, {"fog=linear"}), .01);
    const auto by_distance = session_of(std::vector<Frame>{foggy_ground(.15f, FogPath::distance)});
    EXPECT_LT(fog_error(*by_distance, {}), 1e-5);
    EXPECT_LT(fog_error(*by_distance, {"fog_distance=distance"}), 1e-5);
    EXPECT_GT(fog_error(*by_distance, {"fog_distance=view_depth"}), .01);
}

TEST(Fog, ThatIsNotThereChangesNoBitAtAnySetting) {
    const auto session = session_of(std::vector<Frame>{foggy_ground(0, FogPath::distance)});
    const auto color = [&](const std::vector<std::string>& sets) {
        return must(session->run({.choices = chosen({}, sets), .outputs = {"color"}})).images.at("color").texels;
    };
    const auto plain = color({});
    for (const std::vector<std::string>& sets : fog_settings()) EXPECT_EQ(color(sets), plain) << testing::PrintToString(sets);
}

}  // namespace strata
