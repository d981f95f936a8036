// A column of what the rows of a report would cost on a GPU that need not be there.
#pragma once

#include <filesystem>

#include "replay/report/modeled_cost.h"
#include "ui/report/report_columns.h"

namespace strata::ui {

struct ModeledRequest {
    Report report;
    Request base;  ///< of the report
    const GpuModel* model = nullptr;
    std::filesystem::path program;  ///< model_cost()'s
};

struct ModeledCosts {
    ReportColumn column;               ///< kilocycles of the whole GPU
    std::vector<std::string> missing;  ///< why a row has none
};

/// The cost of each row that was measured. Fails (device lacks) without RADV.
Result<ModeledCosts> model_costs(Session&, const ModeledRequest&, const strata::Progress&);

}  // namespace strata::ui
