// Pictures of the rows of a report as a display shows them, for pages.
#pragma once

#include <span>

#include "replay/report/row_truth.h"

namespace strata {

/// Gives the report and its rows their pictures (Report::truth_picture, Measurement::picture): of the stage's radiance by itself
/// through the frame's exposure and tone curve, or of the whole frame where errors are of the picture or the stage makes no
/// radiance. Rows in the order of the variants. Rows against another truth than the first row's have none, nor has a stage of
/// which later stages read more than images: its truth cannot be shown.
Result<void> add_pictures(Session&, const ReportRequest&, std::span<const Variant>, const RowTruths&, Report&);

}  // namespace strata
