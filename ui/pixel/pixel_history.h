// A pixel through the frame: what every step left of it, and what of that is new.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "replay/session/session.h"

namespace strata::ui {

enum class Change { first, changed, same };

/// A texel of one layer after a step.
struct PixelValue {
    std::string image;  ///< by its name in the graph
    std::uint32_t layer = 0, layers = 1;
    Format format = Format::rgba32f;
    glm::dvec4 value{0};
    Change change = Change::first;  ///< against what the last step that wrote the image left
};

struct PixelStep {
    std::size_t step = 0;  ///< in the plan
    Scope scope;
    std::string name;  ///< as in StepRecord
    std::vector<PixelValue> values;
};

std::vector<PixelStep> history_of(std::span<const StepImages>);

/// As many numbers as the image has channels; of depth the meters, too, that `near` of the view makes of it.
std::string text_of(const PixelValue&, double near);

}  // namespace strata::ui
