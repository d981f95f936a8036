// What the colors of a picture stand for: a bar from the look's black to its white, with the values at its ends.
#pragma once

#include <string>
#include <string_view>

#include "ui/picture/picture_view.h"

namespace strata::ui {

/// What is black, and what is white or the map's last color: "0.25 m".
struct LookEnds {
    std::string black, white;
};
LookEnds ends_of(const Look&, std::string_view unit);
void draw_ramp(ImVec2 from, ImVec2 to, const Look&);
/// Over the lower left corner of a picture that shows numbers by colors; nothing over one that shows colors.
void draw_legend_over(Widgets&, const Placement&, const Look&, std::string_view image);

}  // namespace strata::ui
