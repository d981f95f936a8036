// What the rows of a report would cost on a GPU that need not be there: how often their shaders run, times what Mesa's compiler
// for it says of their throughput (replay/isa).
#pragma once

#include <filesystem>

#include "replay/isa/gpu_models.h"
#include "ui/report/report_columns.h"

namespace strata::ui {

struct ModeledRequest {
    Report report;
    Request base;  ///< of the report
    const GpuModel* model = nullptr;
    std::filesystem::path program;  ///< this one, which has replay/isa's verb: it compiles in a process of its own
};

struct ModeledCosts {
    ReportColumn column;               ///< kilocycles of the whole GPU
    std::vector<std::string> missing;  ///< why a row has none
};

/// GPUs that RADV compiles for, by name.
std::vector<std::string_view> modeled_gpus();

/// Plans, runs once and compiles each row that was measured; a row of which a shader is not counted or not compiled has no cost.
/// Fails (device lacks) without RADV.
Result<ModeledCosts> model_costs(Session&, const ModeledRequest&, const strata::Progress&);

}  // namespace strata::ui
