// A report as one file for a browser: the answer, the plots, the pictures, the table. It asks nothing of a network.
#pragma once

#include <string>

#include "replay/report/report.h"

namespace strata {

/// HTML. Of a report without pictures (ReportRequest::wants_pictures) it shows none; where there are more than
/// page_picture_bytes, those of the answer and of rows on the front come first.
std::string as_html(const Report&);

}  // namespace strata
