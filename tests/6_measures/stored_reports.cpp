#include "tests/6_measures/stored_reports.h"

#include "tests/support/errors.h"

namespace strata {

Report report_with(const std::vector<TimedRow>& rows) {
    Report report{.capture_name = "panes.strata",
                  .capture_id = "09831f90",
                  .truths = {{.is = "exact, in double"}},
                  .width = 64,
                  .height = 36,
                  .device = {.name = "a device", .driver = "its driver", .driver_version = "1.2"},
                  .time_unit = "transparency/alpha_blend"};
    for (const TimedRow& row : rows) {
        Measurement& made = report.rows.emplace_back(Measurement{.technique = row.technique});
        made.accuracy.technique_errors = {{display_rmse, "of white", row.error}};
        made.repeats_ms = row.repeats_ms;
        made.baseline_repeats_ms.assign(row.repeats_ms.size(), 2);
        made.stage_ms = spread_of(made.repeats_ms);
        made.time = ratio_of(made.repeats_ms, made.baseline_repeats_ms);
        made.bytes_per_pixel = 8;
        made.counters = {{.technique = row.technique, .name = "overflowed", .value = row.overflowed}};
    }
    return report;
}

StoredReport stored(const Report& report) { return *parse_report(as_json(report), "report.json"); }

}  // namespace strata
