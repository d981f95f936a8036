// Frames with light volumes around the scenario two_rooms, and runs of indirect/lpv on them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "passes/reference/decoded.h"
#include "replay/images/host_image.h"
#include "tests/support/session.h"

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

/// Everything moved by a turn or a mirror image (its determinant is 1 or -1) around a point. Grids stay along the axes.
inline Frame moved(Frame frame, const glm::dmat3& by, const glm::dvec3& around) {
    const auto place = [&](const glm::dvec3& p) { return by * (p - around) + around; };
    const auto move_direction = [&](glm::vec3& d) { d = glm::vec3(by * glm::dvec3(d)); };
    frame.view.origin = place(frame.view.origin);
    frame.view.to_view = frame.view.to_view * glm::transpose(by);
    if (glm::determinant(by) < 0)  // the picture is mirrored, too
        frame.view.to_view = glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1) * frame.view.to_view;
    for (Draw& draw : frame.draws)
        for (glm::dmat4* to_world : {&draw.to_world, &draw.previous_to_world}) {
            const glm::dvec3 at = place(glm::dvec3((*to_world)[3]));
            *to_world = glm::dmat4(by) * *to_world;
            (*to_world)[3] = glm::dvec4(at, 1);
        }
    for (Light& light : frame.lights) {
        light.position = place(light.position);
        move_direction(light.direction), move_direction(light.axis_u);
    }
    for (Blocker& blocker : frame.blockers) {
        blocker.center = place(blocker.center);
        move_direction(blocker.u), move_direction(blocker.v);
    }
    for (Portal& portal : frame.portals) {
        portal.center = place(portal.center);
        move_direction(portal.u), move_direction(portal.v);
    }
    for (LightVolume& volume : frame.light_volumes) volume.center = place(volume.center);
    return frame;
}

/// The rooms turned around the vertical through the middle of the wall, in a grid that is wide enough for any turn.
inline Frame turned(Frame frame, double yaw) {
    const glm::dvec3 center = frame.light_volumes.front().center;
    frame = moved(std::move(frame), glm::dmat3(glm::rotate(glm::dmat4(1), yaw, glm::dvec3(0, 1, 0))), {0, 0, -2});
    for (LightVolume& volume : frame.light_volumes)
        volume.center = center, volume.half_extent = {5.6f, 2, 5.6f}, volume.cells = {28, 10, 28};
    return frame;
}

}  // namespace strata
