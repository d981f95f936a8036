// Frames with light volumes around the scenario two_rooms, and runs of indirect/lpv on them.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/frame.h"
#include "passes/reference/decoded.h"
#include "replay/images/host_image.h"
#include "tests/support/random_numbers.h"
#include "tests/support/session.h"
#include "tests/support/similar_frame.h"

namespace strata {

inline Request indirect_of(std::size_t frame, const std::vector<std::string>& sets = {}) {
    Request request{.variant = {.frame = frame}, .choices = chosen({"indirect/lpv"}, sets)};
    request.outputs = {"indirect", "surface_normal"};
    return request;
}

/// The door closed in the first, open in the second.
inline std::vector<Frame> two_rooms() { return scenario_frames("two_rooms", 1, 2); }

/// Brightness of the samples in each of the two rooms.
struct Rooms {
    std::vector<double> lit, dark;
};
inline Rooms rooms_of(const Frame& frame, const Run& run) {
    Rooms rooms;
    const HostImage& normals = run.images.at("surface_normal");
    for (std::uint32_t y = 0; y < run.height; ++y)
        for (std::uint32_t x = 0; x < run.width; ++x) {
            const glm::dvec4 normal = texel(normals, x, y);
            if (normal.w <= 0) continue;
            const SurfacePoint p = decoded_surface(frame, {normal, glm::dvec4(0), glm::dvec4(0)}, x, y);
            const double side = (frame.view.origin + glm::transpose(glm::dmat3(frame.view.to_view)) * p.position).x;
            if (std::abs(side) < .08) continue;  // the door and its way through the wall
            const glm::dvec4 light = texel(run.images.at("indirect"), x, y);
            (side < 0 ? rooms.lit : rooms.dark).push_back(light.x + light.y + light.z);
        }
    return rooms;
}

inline double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / double(values.size());
}

/// The two rooms with the door open, and blockers of any size and direction in them, every second with a portal.
inline Frame with_random_blockers(std::size_t count, unsigned seed) {
    Frame frame = scenario_frames("two_rooms", 1, 2)[1];
    Numbers numbers(seed);
    while (frame.blockers.size() < count) {
        Blocker blocker;
        blocker.center = glm::dvec3(0, 1.4, -2) + glm::dvec3(numbers.box(1)) * glm::dvec3(4.4, 1.8, 2.4);
        blocker.u = numbers.direction(), blocker.v = numbers.across(blocker.u);
        blocker.half_u = numbers.from(.05f, 1), blocker.half_v = numbers.from(.05f, 1);
        if (frame.blockers.size() % 2 == 0)
            frame.portals.push_back({.center = blocker.center,
                                     .u = blocker.u,
                                     .v = blocker.v,
                                     .half_u = .5f * blocker.half_u,
                                     .half_v = .5f * blocker.half_v,
                                     .blocker = static_cast<std::uint32_t>(frame.blockers.size())});
        frame.blockers.push_back(blocker);
    }
    // A frame's portals come in any order.
    std::ranges::reverse(frame.portals);
    for (Light& light : frame.lights) std::ranges::fill(light.portals, static_cast<std::uint32_t>(frame.portals.size() - 1));
    return frame;
}

/// The same, and fifty windows in each of twenty blockers.
inline Frame with_a_thousand_windows() {
    Frame frame = with_random_blockers(27, 4);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const auto blocker = static_cast<std::uint32_t>(7 + i % 20);
        const Blocker& wall = frame.blockers[blocker];
        const float across = -.95f + .19f * float(i / 20 % 10), up = -.9f + .4f * float(i / 200);
        frame.portals.push_back({.center = wall.center + glm::dvec3(across * wall.half_u * wall.u + up * wall.half_v * wall.v),
                                 .u = wall.u,
                                 .v = wall.v,
                                 .half_u = .04f * wall.half_u,
                                 .half_v = .1f * wall.half_v,
                                 .blocker = blocker});
    }
    return frame;
}

/// The rooms turned around the vertical through the middle of the wall, in a grid that is wide enough for any turn.
inline Frame turned(Frame frame, double yaw) {
    const glm::dvec3 center = frame.light_volumes.front().center;
    frame = similar(std::move(frame),
                    {.turn = glm::dmat3(glm::rotate(glm::dmat4(1), yaw, glm::dvec3(0, 1, 0))), .around = {0, 0, -2}});
    for (LightVolume& volume : frame.light_volumes)
        volume.center = center, volume.half_extent = {5.6f, 2, 5.6f}, volume.cells = {28, 10, 28};
    return frame;
}

}  // namespace strata
