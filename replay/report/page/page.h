// A report as one file for a browser: the answer, the plots, the pictures, the table. It asks nothing of a network.
#pragma once

#include <string>

#include "replay/report/report.h"

namespace strata {

/// Pictures in a page take no more bytes than this; those of rows on the front and of the answer come first.
inline constexpr std::size_t page_picture_bytes = 4'000'000;

/// HTML. Of a report without pictures (ReportRequest::wants_pictures) it shows none.
std::string as_html(const Report&);

}  // namespace strata
