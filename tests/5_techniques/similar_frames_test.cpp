// Every technique is as far off in a frame that is moved, turned, mirrored or of another size as in the frame itself: errors do
// not depend on where the world's origin is, on its axes or on the unit of length. The bounds are measured. (For the unit of
// light: unit_of_light_test.cpp; for grids of light volumes that follow the eye: light_volume_moves_test.cpp.)
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/metric.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "tests/support/session.h"
#include "tests/support/similar_frame.h"

namespace strata {
namespace {

/// No bound: the stage has a length in meters, which does not change with the frame.
constexpr double in_meters = std::numeric_limits<double>::infinity();

/// A stage in a scenario, and by how much of itself its error changes at most.
struct Case {
    std::string_view scenario;
    Stage stage;
    std::uint32_t samples = 1;
    double moved = 0;  ///< by whole and by broken meters, by 100 km, by a quarter turn
    double mirrored = 0;
    double resized = 0;       ///< to a tenth and to 10,000 times its size
    double tiny = in_meters;  ///< to a thousandth: lamps are taken to be 1 cm away at least
};

std::ostream& operator<<(std::ostream& out, const Case& tested) { return out << tested.scenario << " " << name(tested.stage); }

constexpr Case cases[] = {
    {.scenario = "city_of_boxes", .stage = Stage::culling, .tiny = 0},
    // Texels of maps and steps of shafts lie elsewhere in a scene that has moved.
    {.scenario = "courtyard", .stage = Stage::shadows, .moved = .005, .mirrored = .001, .resized = .001, .tiny = .001},
    {.scenario = "hall_with_shafts", .stage = Stage::sun_shafts, .moved = .05, .mirrored = .02, .resized = .001, .tiny = .001},
    {.scenario = "materials", .stage = Stage::gbuffer, .moved = .001, .mirrored = .05, .resized = .03, .tiny = .01},
    {.scenario = "blocker_rooms", .stage = Stage::edges, .samples = 4},
    // Drops have a size, and their pattern a place in the world; ambient occlusion has a radius.
    {.scenario = "roof_in_rain", .stage = Stage::rain, .moved = .05, .mirrored = .01, .resized = in_meters},
    {.scenario = "corners", .stage = Stage::occlusion, .moved = .001, .mirrored = .03, .resized = in_meters},
    {.scenario = "cornell_box", .stage = Stage::indirect, .moved = .001, .mirrored = .005, .resized = .005},
    {.scenario = "blocker_rooms", .stage = Stage::lighting, .moved = .001, .mirrored = .001, .resized = .005},
    {.scenario = "light_types", .stage = Stage::lighting, .moved = .001, .mirrored = .1, .resized = .001},
    {.scenario = "glass_and_smoke", .stage = Stage::combine, .moved = .01, .mirrored = .01, .resized = .01},
    {.scenario = "glass_and_smoke", .stage = Stage::transparency, .moved = .01, .mirrored = .02, .resized = .05},
    // A tenth as large, lanterns are less than 1 cm from what they light: other light blooms.
    {.scenario = "night_market", .stage = Stage::lens, .moved = .01, .mirrored = .01, .resized = .3},
    {.scenario = "night_market", .stage = Stage::film, .moved = .02, .mirrored = .05, .resized = .03},
};

struct Change {
    std::string_view name;
    Similarity by;
    double Case::*bound;
};

const Change changes[] = {
    {"by 64 m", {.shift = {64, -32, 64}}, &Case::moved},       {"by 25 cm", {.shift = {.25, .25, -.25}}, &Case::moved},
    {"by 100 km", {.shift = {1e5, 1e3, -1e5}}, &Case::moved},  {"by 90 degrees", {.turn = quarter_turn}, &Case::moved},
    {"mirrored", {.turn = mirror_x}, &Case::mirrored},         {"a tenth as large", {.scale = .1}, &Case::resized},
    {"10,000 times as large", {.scale = 1e4}, &Case::resized}, {"a thousandth as large", {.scale = 1e-3}, &Case::tiny},
};

/// Halves of positions end at 65,504 m, so that in the largest frame the far half of what is seen is missing; slices of `voxel`
/// are an inch thick.
bool has_a_size_of_its_own(const Technique& technique) {
    return technique.name == "gbuffer/wide" || technique.name == "gbuffer/oct_half" || technique.name == "transparency/voxel";
}

class SimilarFrames {
public:
    explicit SimilarFrames(const Case& tested) : case_(tested) {
        Frame plain = scenario_frames(tested.scenario, tested.samples).front();
        while (plain.view.width > 96) plain.view.width /= 2, plain.view.height /= 2;
        std::vector<Frame> frames{plain};
        for (const Change& change : changes) frames.push_back(similar(plain, change.by));
        session_ = session_of(std::move(frames));
    }

    void expect_equal_errors(const Technique& technique) {
        const double plain = error(technique, 0);
        if (std::isnan(plain)) return;  // it cannot do the frame
        for (std::size_t i = 0; i < std::size(changes); ++i) {
            const double bound = case_.*changes[i].bound;
            if (std::isinf(bound) || (changes[i].by.scale > 1 && has_a_size_of_its_own(technique))) continue;
            // Below the least, errors are rounding.
            constexpr double least = 1e-6;
            const double changed = error(technique, i + 1);
            EXPECT_LE(std::abs(changed - plain), bound * std::max(plain, least))
                << technique.name << " in " << case_.scenario << ", " << changes[i].name << ": " << changed << ", was " << plain;
        }
    }

private:
    /// The stage's error, or NaN.
    double error(const Technique& technique, std::size_t frame) {
        const Request request{.variant = {.frame = frame}, .choices = chosen({std::string(technique.name)})};
        const Accuracy accuracy = must(session_->judge(request, technique.stage, Against::truth));
        return accuracy.not_supported.empty() ? accuracy.technique_errors.front().value : std::nan("");
    }

    const Case& case_;
    std::unique_ptr<Session> session_;
};

class ExhaustiveSimilarFrames : public testing::TestWithParam<Case> {};

TEST_P(ExhaustiveSimilarFrames, LeaveTheErrorOfEveryTechnique) {
    SimilarFrames frames(GetParam());
    for (const Technique* technique : techniques_of(GetParam().stage)) frames.expect_equal_errors(*technique);
}

INSTANTIATE_TEST_SUITE_P(Stages, ExhaustiveSimilarFrames, testing::ValuesIn(cases), [](const auto& tested) {
    return fmt::format("{}_{}", name(tested.param.stage), tested.param.scenario);
});

TEST(SimilarFrames, LeaveTheErrorsOfShadows) { SimilarFrames(cases[1]).expect_equal_errors(**find_technique("shadows/pcf")); }

}  // namespace
}  // namespace strata
