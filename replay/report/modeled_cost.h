// The cost of a row on a GPU that need not be there: how often its shaders run, times what Mesa's compiler for it says of their
// throughput (replay/isa). Instructions alone: no memory, no caches, no blending.
#pragma once

#include <filesystem>

#include "replay/isa/gpu_models.h"
#include "replay/report/report.h"

namespace strata {

/// GPUs that RADV compiles for, by name.
std::vector<std::string_view> modeled_gpus();

/// Plans, runs once and compiles a row of a report that started from `base`; `program` is this one, which compiles in a process
/// of its own. A row that cannot do the frame, or of which a shader is not counted or not compiled, has no cost. Fails (device
/// lacks) without RADV.
Result<ModeledCost> model_cost(Session&, const Request& base, const Measurement&, const GpuModel&,
                               const std::filesystem::path& program);

}  // namespace strata
