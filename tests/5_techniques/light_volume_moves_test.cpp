// Light volumes follow what is done to a whole frame: a frame that is moved, scaled, turned or mirrored as a whole shows the same
// light, but for what the cells of a grid that stays along the world's axes make of it. The figures are measured.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "replay/images/host_image.h"
#include "tests/5_techniques/light_volume_scenes.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// Root mean square of the difference of two pictures, relative to the first.
double difference(const HostImage& a, const HostImage& b, bool is_mirrored = false) {
    double error = 0, whole = 0;
    for (std::uint32_t y = 0; y < a.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < a.shape.extent.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double one = texel(a, x, y)[c], other = texel(b, is_mirrored ? a.shape.extent.width - 1 - x : x, y)[c];
                error += (one - other) * (one - other), whole += one * one;
            }
    return std::sqrt(error / whole);
}

Frame small(std::string_view scenario) {
    Frame frame = scenario_frames(scenario).front();
    frame.view.width = 64, frame.view.height = 36;
    return frame;
}

/// A change of a whole frame, and the largest difference that it may make to the light.
struct Change {
    std::string name;
    Similarity by;
    double most = 0;  ///< relative
};

void expect_the_same_light(const Frame& plain, const std::vector<Change>& changes, const std::vector<std::string>& sets = {}) {
    std::vector<Frame> frames{plain};
    for (const Change& change : changes) frames.push_back(similar(plain, change.by));
    const auto session = session_of(frames);
    const HostImage here = must(session->run(indirect_of(0, sets))).images.at("indirect");
    for (std::size_t i = 0; i < changes.size(); ++i) {
        const HostImage there = must(session->run(indirect_of(i + 1, sets))).images.at("indirect");
        const double differs = difference(here, there, glm::determinant(changes[i].by.turn) < 0);
        testing::Test::RecordProperty(changes[i].name, std::to_string(differs));
        EXPECT_LT(differs, changes[i].most) << changes[i].name;
    }
}

Change by_meters(const std::string& name, const glm::dvec3& by, double most) { return {name, {.shift = by}, most}; }

// Cells are .5 m wide, and 1 m in the second cascade. The grid goes along with a whole number of cells; half a cell changes which
// cell a surface lies in.
TEST(LightVolumeMoves, OfCascadesByWholeCellsChangeNextToNothing) {
    expect_the_same_light(small("courtyard"),
                          // The eye that lights stays where it is: a point at an edge is rounded into another cell, .0021.
                          {by_meters("level, a cell of the second", {1, 0, -1}, 3e-3),
                           by_meters("up, a cell of the second", {0, 1, 0}, .02), by_meters("many cells", {37, -12, 5}, .02),
                           by_meters("a cell of the finest, half of one of the second", {.5, 0, -.5}, .15),
                           by_meters("half a cell of the finest", {.25, .25, .25}, .4)});
}

TEST(LightVolumeMoves, OfLocalVolumesAndTheirScaleChangeRoundingAlone) {
    const Frame room = small("cornell_box");
    const glm::dvec3 around = room.light_volumes[0].center;
    expect_the_same_light(room, {by_meters("anywhere", {3.21, -7.4, .93}, 2e-3),
                                 {"twice as large", {.scale = 2}, 2e-3},
                                 {"a tenth as large", {.scale = .1}, 5e-3},
                                 {"mirrored", {.turn = mirror_x, .around = around}, .02},
                                 {"yaw by 90 degrees", {.turn = quarter_turn, .around = around}, .02},
                                 {"yaw by 180 degrees", {.turn = quarter_turn * quarter_turn, .around = around}, .02}});
}

}  // namespace
}  // namespace strata
