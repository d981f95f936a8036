// Light volumes follow what is done to a whole frame: a frame that is moved, scaled, turned or mirrored as a whole shows the same
// light, but for what the cells of a grid that stays along the world's axes make of it. The figures are measured.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/light_types.h"
#include "replay/images/host_image.h"
#include "tests/5_techniques/light_volume_scenes.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Frame shifted(Frame frame, const glm::dvec3& by) {
    frame.view.origin += by;
    for (Draw& draw : frame.draws)
        for (glm::dmat4* place : {&draw.to_world, &draw.previous_to_world}) (*place)[3] += glm::dvec4(by, 0);
    for (Light& light : frame.lights) light.position += by;
    for (Blocker& blocker : frame.blockers) blocker.center += by;
    for (Portal& portal : frame.portals) portal.center += by;
    for (LightVolume& volume : frame.light_volumes) volume.center += by;
    return frame;
}

/// All lengths times a factor; a light's intensity times its square, so that surfaces are as bright.
Frame scaled(Frame frame, double factor) {
    frame.view.origin *= factor;
    for (Draw& draw : frame.draws)
        for (glm::dmat4* place : {&draw.to_world, &draw.previous_to_world})
            *place = glm::dmat4(factor, 0, 0, 0, 0, factor, 0, 0, 0, 0, factor, 0, 0, 0, 0, 1) * *place;
    for (Light& light : frame.lights) {
        light.position *= factor;
        light.range *= float(factor), light.source_radius *= float(factor), light.half_extent *= float(factor);
        if (!is_area(light.type)) light.intensity *= float(factor * factor);  // those of area lights are radiance
    }
    for (Blocker& blocker : frame.blockers)
        blocker.center *= factor, blocker.half_u *= float(factor), blocker.half_v *= float(factor);
    for (Portal& portal : frame.portals) portal.center *= factor, portal.half_u *= float(factor), portal.half_v *= float(factor);
    for (LightVolume& volume : frame.light_volumes) volume.center *= factor, volume.half_extent *= float(factor);
    return frame;
}

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

/// What a frame that is changed as a whole differs by from the frame itself.
struct Change {
    std::string name;
    std::function<Frame(const Frame&)> make;
    double most = 0;  ///< relative
    bool mirrors = false;
};

void expect_the_same_light(const Frame& plain, const std::vector<Change>& changes, const std::vector<std::string>& sets = {}) {
    std::vector<Frame> frames{plain};
    for (const Change& change : changes) frames.push_back(change.make(plain));
    const auto session = session_of(frames);
    const HostImage here = must(session->run(indirect_of(0, sets))).images.at("indirect");
    for (std::size_t i = 0; i < changes.size(); ++i) {
        const HostImage there = must(session->run(indirect_of(i + 1, sets))).images.at("indirect");
        const double differs = difference(here, there, changes[i].mirrors);
        testing::Test::RecordProperty(changes[i].name, std::to_string(differs));
        EXPECT_LT(differs, changes[i].most) << changes[i].name;
    }
}

Change by_meters(const std::string& name, const glm::dvec3& by, double most) {
    return {name, [by](const Frame& frame) { return shifted(frame, by); }, most};
}

// Cells are .5 m wide, and 1 m in the second cascade. The grid goes along with a whole number of cells; half a cell changes which
// cell a surface lies in.
TEST(LightVolumeMoves, OfCascadesByWholeCellsChangeNextToNothing) {
    expect_the_same_light(small("courtyard"),
                          {by_meters("level, a cell of the second", {1, 0, -1}, 2e-3),
                           by_meters("up, a cell of the second", {0, 1, 0}, .02), by_meters("many cells", {37, -12, 5}, .02),
                           by_meters("a cell of the finest, half of one of the second", {.5, 0, -.5}, .15),
                           by_meters("half a cell of the finest", {.25, .25, .25}, .4)});
}

TEST(LightVolumeMoves, OfLocalVolumesAndTheirScaleChangeRoundingAlone) {
    const glm::dmat3 mirror(-1, 0, 0, 0, 1, 0, 0, 0, 1), quarter(0, 0, -1, 0, 1, 0, 1, 0, 0);
    const auto turned_by = [](const glm::dmat3& by) {
        return [by](const Frame& frame) { return moved(frame, by, frame.light_volumes[0].center); };
    };
    expect_the_same_light(small("cornell_box"), {by_meters("anywhere", {3.21, -7.4, .93}, 2e-3),
                                                 {"twice as large", [](const Frame& f) { return scaled(f, 2); }, 2e-3},
                                                 {"a tenth as large", [](const Frame& f) { return scaled(f, .1); }, 5e-3},
                                                 {"mirrored", turned_by(mirror), .02, true},
                                                 {"yaw by 90 degrees", turned_by(quarter), .02},
                                                 {"yaw by 180 degrees", turned_by(quarter * quarter), .02}});
}

}  // namespace
}  // namespace strata
