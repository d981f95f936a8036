// Reports in the background: what a job measures, how it is stopped at once, and pictures that go on meanwhile.
#pragma once

#include <map>
#include <stop_token>

#include "ui/modelled_costs.h"
#include "ui/replayer.h"

namespace strata::ui {

/// A report, and what is shown of it.
struct Study {
    Request base;  ///< what it started from: the choices of the other stages
    Report report;
    std::vector<ReportColumn> columns;
    std::map<std::string, std::vector<std::string>> missing = {};  ///< by a column's label: why a row lacks it
};

/// A stop that is requested ends it before the next thing that the session would do.
JobOf<Study> start_report(Replayer&, const ReportRequest&, std::string capture_name, std::stop_source);
/// The same study with the modelled cost of a GPU.
JobOf<Study> start_modelling(Replayer&, Study, const GpuModel&, std::stop_source);

}  // namespace strata::ui
