// The transparent fragments of a pixel as people read them: nearest first, with what is left of the light behind each.
#pragma once

#include <string>
#include <vector>

#include "passes/reference/fragments.h"
#include "ui/replayer/live_query.h"

namespace strata::ui {

struct PixelFragment {
    Fragment fragment;
    glm::dvec3 in_front{1};  ///< what the ones nearer than it let through
    std::string drawn_by;
};

/// Of one sample.
struct SampleFragments {
    std::vector<PixelFragment> fragments;  ///< nearest first
    glm::dvec3 through{1};                 ///< what all of them let through
    glm::dvec3 light{0};                   ///< what all of them add
    bool undecided = false;                ///< the list hangs on rounding
};

struct PixelQuestion {
    Request request;
    glm::uvec2 pixel{0};
    friend bool operator==(const PixelQuestion&, const PixelQuestion&) = default;
};

/// By sample.
Result<std::vector<SampleFragments>> fragments_of(Session&, Progress&, const PixelQuestion&);

}  // namespace strata::ui
