// What a report says of each of its rows: the one list of columns for every format. A new column is an entry in
// report_columns.cpp.
#pragma once

#include "replay/report/pooled.h"
#include "replay/tables/sheet.h"

namespace strata {

Sheet sheet_of(const Report&);
Sheet sheet_of(const Pool&);

/// The first row that can do the frame, or null.
const Measurement* first_measured(const Report&);
/// The error that ranks the rows: "display rmse touched".
RankingError ranking_error(const Report&);
/// The title of its column: "display rmse touched, % of white".
std::string title_of(const RankingError&);
CellKind kind_of(const RankingError&);
/// Whether errors over what the stage touches say more than those over the frame.
bool leaves_much(const Report&);

/// Heading, table and what stands below it.
Page page_of(const Report&);
Page page_of(const Pool&);
/// Several reports, and what they are pooled to.
Page page_of(std::span<const Report>, const Pool&);

}  // namespace strata
