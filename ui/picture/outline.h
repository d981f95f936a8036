// The outline of a draw over a picture: along the edges of the pixels that show it, and of those where it is hidden.
#pragma once

#include <span>
#include <vector>

#include "replay/session/session.h"
#include "ui/picture/picture_view.h"

namespace strata::ui {

/// From one corner of pixels to another, along a row or a column.
struct OutlineLine {
    std::uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    friend bool operator==(const OutlineLine&, const OutlineLine&) = default;
};

struct Outline {
    std::uint32_t draw = 0;                 ///< as in Session::draw_cover()
    Request request;                        ///< that it is of
    std::uint32_t width = 0, height = 0;    ///< of the picture
    std::size_t shown = 0, hidden = 0;      ///< pixels
    glm::uvec2 from{0}, to{0};              ///< around all of them; to: beyond
    std::vector<OutlineLine> around_shown;  ///< the edges of the pixels that show it
    std::vector<OutlineLine> around_all;    ///< of those that would, were nothing before it
};

/// The cover is `width` pixels wide, row by row.
Outline outline_of(std::span<const Cover>, std::uint32_t width);

/// Nothing on a picture of another shape, or where the request looks at another frame or from elsewhere.
void draw_outline(const Placement&, const Outline&, const Request&);

}  // namespace strata::ui
