// A report as one file for a browser: the answer, the plots, the pictures, the table. It asks nothing of a network.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "replay/markup_text.h"
#include "replay/report/hard_cases.h"
#include "replay/report/pooled.h"

namespace strata {

/// Room in a file.
struct PageRoom {
    std::size_t picture_bytes = page_picture_bytes;
    bool has_every_plot = true;  ///< false: the first figure up or the first across is in each
};

/// HTML. Of a report without pictures (ReportRequest::wants_pictures) it shows none; where there are more than
/// PageRoom::picture_bytes, those of the answer and of rows on the front come first.
std::string as_html(const Report&, const PageRoom& = {});
/// Its heading: "Use weighted: 0.4 % of white, not seen, at 0.62 times the time of alpha_blend".
std::string verdict_of(const Report&);

/// The plot that its page begins with, as an SVG file.
std::string as_svg(const Report&);

/// Reports of several frames: the answer over all, the error of each row on each frame, and the page of each.
std::string as_html(std::span<const Report>, const Pool&);
std::string as_svg(std::span<const Report>, const Pool&);

/// Techniques by cases, the size of failures in the classes of the scale.
std::string as_html(const HardCaseReport&);

}  // namespace strata
