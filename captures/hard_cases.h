// The frames on which techniques of transparency come to grief, small and computable by hand (docs/algorithms/transparency.md 8,
// H1 to H16). What a technique makes of them is measured by replay/report/hard_cases.h.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace strata {

struct Frame;  // capture_format/frame.h

/// What is measured over a case's frames, per pixel and channel, relative to max(1, the truth); the worst counts.
enum class HardMeasure {
    error,         ///< difference from the truth
    unsteadiness,  ///< how much the difference from the truth changes from frame to frame, where nothing should
    change,        ///< difference from the first frame, where there should be none
    tie,           ///< the less of error and change: any rule will do that is kept
    share,         ///< what is missing of the front card, which alone is red, where most is: 1 less the smallest share of it
};

struct HardCase {
    std::string_view name;  ///< "H14b thin smoke before an opaque card"
    std::string_view question;
    HardMeasure measure = HardMeasure::error;
    double tolerance = 0;  ///< up to here a technique holds
    std::vector<Frame> (*build)() = nullptr;
};

/// All of them, in the order of docs/algorithms/transparency.md 8.
std::span<const HardCase> hard_cases();

}  // namespace strata
