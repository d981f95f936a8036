// Compiles pipelines and asks the driver what it made of them. Nothing runs: the device may be RADV's for hardware that is not
// there, which crashes at the first memory and aborts for a name it does not know (Mesa 22.3). So only a process that has
// nothing to lose calls this: see compile_elsewhere.h.
#pragma once

#include <span>

#include "replay/isa/compiled_pipeline.h"
#include "replay/isa/pipeline_request.h"

namespace strata {

enum class CompilerTexts { left, kept };

/// On a device of this process by its index in list_devices(). What cannot be compiled says so in its place; fails (device lacks)
/// when the device is not there or does not describe its pipelines.
Result<Compilation> compile_here(std::span<const PipelineRequest>, std::uint32_t device, CompilerTexts);

}  // namespace strata
