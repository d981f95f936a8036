// What is stated of a technique, and measured: failures that are known, and ratios of times.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "passes/stage.h"

namespace strata {

struct Frame;  // capture_format/frame.h

/// A hard case (replay/report/hard_cases.h) that a technique is known not to hold, and by how much: neither more nor less.
struct KnownFailure {
    std::string_view hard_case;
    double error = 0;
    std::string_view because;
};

/// What is changed in a scenario's frame before it is measured.
struct FrameChange {
    std::string_view name = {};  ///< "64 lights"; empty: nothing is changed
    void (*change)(Frame&) = nullptr;
};

/// The condition on which a ratio compares different work: one way counts more than a number.
struct RatioWitness {
    std::string_view counter = {};    ///< of TimeRatio::counters; empty: the work always differs
    std::string_view otherwise = {};  ///< said where it does not happen: "nothing overflowed"
    double more_than = 0;
};

/// How many times as long one way takes as another, as a source states it: `strata bench` measures it. A way is settings of the
/// technique ("slices=64 bits=16"; none: its defaults), or another technique of its stage by name, with its settings.
struct TimeRatio {
    std::string_view name;
    std::string_view of, against;  ///< the ways; the ratio is the time of the one by that of the other
    /// Parts of the names of the technique's steps that count; none: all of them.
    std::vector<std::string_view> steps = {};
    std::optional<double> published = {};
    std::string_view source = {};  ///< of what is published: times, machine, extent
    std::string_view scenario = "particle_storm";
    std::vector<std::string_view> counters = {};  ///< that explain it, of either way
    RatioWitness witness = {};
    /// In place of `steps`: stages of which every step counts, whichever technique it belongs to.
    std::vector<Stage> stages = {};
    /// What differs between the frames of the two ways.
    FrameChange of_frame = {}, against_frame = {};
    bool of_unchanged = false;  ///< the one is timed in a frame that follows itself (Abilities::keeps_work)
};

/// What is stated of a technique, and measured.
struct Claims {
    std::vector<KnownFailure> failures = {};
    std::vector<TimeRatio> ratios = {};
};

}  // namespace strata
