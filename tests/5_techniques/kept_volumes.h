// Runs of light volumes that are kept over frames (relight=changed), and what they lit.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture_format/frame.h"
#include "replay/images/host_image.h"
#include "tests/support/session.h"

namespace strata::kept_volumes {

/// What a run of a frame lit, and what it showed.
struct Lit {
    std::uint64_t injected = 0, cells = 0, faces = 0;
    HostImage indirect = {};

    std::array<std::uint64_t, 3> work() const { return {injected, cells, faces}; }
};

inline std::uint64_t counter_of(const Run& run, std::string_view name) {
    const auto found = std::ranges::find_if(
        run.counters, [&](const CounterRecord& counter) { return counter.technique == "indirect/lpv" && counter.name == name; });
    return found == run.counters.end() ? 0 : found->value;
}

/// Few texels and steps: what is kept does not depend on them. All volumes are lit, also those without a reader in view.
inline Request coarse_light_of(std::size_t frame, std::vector<std::string> sets) {
    sets.insert(sets.begin(), {"map_size=32", "iterations=8"});
    Request request{.variant = {.frame = frame}, .choices = chosen({"indirect/lpv"}, sets)};
    request.variant.force.assign(all_features().begin(), all_features().end());
    request.outputs = {"indirect"};
    request.once = true;  // what comes from the memo has the counters of the run that made it
    return request;
}

inline Lit lit(Session& session, std::size_t frame, const std::vector<std::string>& sets) {
    const Request request = coarse_light_of(frame, sets);
    const Run run = must(session.run(request));
    return {counter_of(run, "injected"), counter_of(run, "cells relit"), counter_of(run, "faces rebuilt"),
            run.images.at("indirect")};
}

inline Lit kept(Session& session, std::size_t frame, std::vector<std::string> sets = {}) {
    sets.emplace_back("relight=changed");
    return lit(session, frame, sets);
}

/// The picture of a frame whose volumes are lit anew.
inline HostImage lit_anew(Session& session, std::size_t frame) { return lit(session, frame, {"relight=always"}).indirect; }

/// Two rooms with the door closed, half open, wide open, seen from one place.
inline std::vector<Frame> still_rooms() {
    std::vector<Frame> frames = scenario_frames("two_rooms", 1, 3);
    for (Frame& frame : frames) frame.view = frames.front().view;
    return frames;
}

inline std::uint64_t faces_in(const glm::uvec3& n) {
    const auto of = [](std::uint64_t x, std::uint64_t y, std::uint64_t z) { return (x - 1) * y * z; };
    return of(n.x, n.y, n.z) + of(n.y, n.x, n.z) + of(n.z, n.x, n.y);
}

inline constexpr std::array<std::uint64_t, 3> no_work{};

}  // namespace strata::kept_volumes
