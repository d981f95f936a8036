// A scenario replayed for a test, with the validation layer on: a message of it fails the test that caused it.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "replay/session/session.h"

namespace strata {

/// Frames 0 .. count - 1 of a scenario at its natural extent.
std::vector<Frame> scenario_frames(std::string_view scenario, std::uint32_t samples = 1, std::uint32_t count = 1);

/// A session over a scenario. No device is a failure, not a skip.
std::unique_ptr<Session> scenario_session(std::string_view scenario, std::uint32_t samples = 1, std::uint32_t count = 1);

/// With validation.
std::unique_ptr<Session> session_of(std::vector<Frame> frames);

/// One session that serves every scenario: the device and its pipelines are made once per program, which is most of what a small
/// test costs. Frames and techniques are chosen by the request; on_scenario() makes one, at 160 pixels across or less.
Session& session_of_scenarios();
Request on_scenario(std::string_view scenario, std::uint32_t samples = 1);

/// What the transparency technique of a run counted under the name.
std::uint64_t counted(const Run&, std::string_view name);

/// Replays frame 0 as recorded: the hash of what is displayed.
std::string display_hash(Session&);

/// What --use and --set would say.
ChoiceChanges chosen(const std::vector<std::string>& uses, const std::vector<std::string>& sets = {});
/// One --set more.
void set(Request&, const std::string& text);

/// The value, or a failed test and an abort of it.
template <typename T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().sentence);
    return *std::move(result);
}
inline void must(const Result<void>& result) {
    if (!result) throw std::runtime_error(result.error().sentence);
}

}  // namespace strata
