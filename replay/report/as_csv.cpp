// Reports as comma-separated values: a line for each row of each capture, then the pooled ones.
#include "replay/report/report_columns.h"

namespace strata {

std::string as_csv(const Report& report) { return as_csv(std::vector{sheet_of(report)}); }

std::string as_csv(std::span<const Report> reports, const Pool& pool) {
    std::vector<Sheet> sheets;
    for (const Report& report : reports) sheets.push_back(sheet_of(report));
    sheets.push_back(sheet_of(pool));
    return as_csv(sheets);
}

}  // namespace strata
