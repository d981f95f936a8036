// What frame.h says of winding: which side of a triangle is seen, in worlds of either hand, by the device and by the reference.
#include <array>
#include <atomic>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/view.h"
#include "passes/frame_images.h"
#include "passes/reference/raster.h"
#include "tests/support/session.h"

namespace strata {
namespace {

struct Seen {
    Handedness handedness;
    double eye_z;
    bool mirrored, visible;
};

/// A white triangle whose cross(b - a, c - a) is +z, of one side.
Frame triangle_from(const Seen& seen) {
    Frame frame;
    frame.view =
        look_at({.eye = {0, 0, seen.eye_z}, .target = {0, 0, 0}, .width = 8, .height = 8, .handedness = seen.handedness});
    Mesh& mesh = frame.meshes.emplace_back();
    mesh.positions = {{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}};
    mesh.indices = {0, 1, 2};
    frame.materials.push_back({.lighting_model = LightingModel::unlit});
    frame.draws.emplace_back();
    if (seen.mirrored) frame.draws[0].to_world[0][0] = frame.draws[0].previous_to_world[0][0] = -1;
    return frame;
}

// Of a right-handed world the triangle turns counter-clockwise for who sees it, of a left-handed one clockwise.
constexpr Seen cases[] = {
    {Handedness::right, 3, false, true},  {Handedness::right, -3, false, false}, {Handedness::left, 3, false, true},
    {Handedness::left, -3, false, false}, {Handedness::right, 3, true, true},    {Handedness::right, -3, true, false},
    {Handedness::left, 3, true, true},    {Handedness::left, -3, true, false},
};

TEST(Coordinates, TheFrontOfATriangleIsWhereTheCrossProductOfItsEdgesPointsInAnyWorld) {
    std::vector<Frame> frames;
    for (const Seen& seen : cases) frames.push_back(triangle_from(seen));
    const auto session = must(Session::open(frames, {.validation = true}));
    for (std::size_t i = 0; i < std::size(cases); ++i) {
        const auto run = must(session->run({.variant = {.frame = i}, .outputs = {"color"}}));
        EXPECT_EQ(in_double(run.images.at("color")).at(4, 4).x > .5, cases[i].visible) << "case " << i << " on the device";
        std::atomic<int> points = 0;
        rasterize(frames[i], std::array{0u}, {}, [&](const RasterPoint&) { ++points; });
        EXPECT_EQ(points > 0, cases[i].visible) << "case " << i << " in double";
    }
}

}  // namespace
}  // namespace strata
