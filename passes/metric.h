// What a stage is judged by.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passes/image_set.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// One named number with its unit; smaller is better. The first metric of a judge is the stage's error.
struct Metric {
    std::string name, unit;
    double value = 0;
    bool is_detail = false;  ///< left out of tables for people
};

/// The name of a root mean square over sRGB-encoded display light (DisplayError in passes/reference/display_light.h).
inline constexpr const char* display_rmse = "display rmse";

/// Whether its value is a share of white, which people read in percent.
inline bool is_of_white(const Metric& metric) { return metric.unit == "of white"; }

using Truth = ImageSet (*)(const StageInput&);
using Judge = std::vector<Metric> (*)(const ImageSet& result, const ImageSet& truth, const StageInput&);

/// Makes undecided samples of a truth with alternatives what is nearest to the result, and decided. How far an error may thereby
/// be too small: a bound of the stage's error, in its unit.
using Settle = Metric (*)(const ImageSet& result, ImageSet& truth);

/// What techniques approximate: the stage's truth, or at some of their settings another one.
struct TruthRow {
    std::string_view name = {};  ///< empty: the stage's truth
    Truth make = nullptr;
    std::string_view is = "exact, in double";  ///< how far a person may trust it
};

}  // namespace strata
