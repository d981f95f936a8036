// Reports in the background: what a job measures, how it is stopped at once, and pictures that go on meanwhile.
#pragma once

#include <filesystem>
#include <map>

#include "ui/replayer/replayer.h"
#include "ui/report/modeled_costs.h"

namespace strata::ui {

/// A report, and what is shown of it.
struct Study {
    Request base;  ///< what it started from: the choices of the other stages
    Report report;
    std::vector<ReportColumn> columns;
    std::map<std::string, std::vector<std::string>> missing = {};  ///< by a column's label: why a row lacks it
};

JobOf<Study> start_report(Replayer&, const ReportRequest&, std::string capture_name);
/// The same study with the modeled cost of a GPU, which `program` (Model::program) compiles for.
JobOf<Study> start_modeling(Replayer&, Study, const GpuModel&, std::filesystem::path program);

}  // namespace strata::ui
