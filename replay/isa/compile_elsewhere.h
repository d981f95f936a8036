// Compiling in a process of its own, which is this program again with a hidden verb: Mesa's RADV compiles for a named GPU that is
// not there (RADV_FORCE_FAMILY), aborts for a name it does not know, and with the variable set shows no real GPU. So it never
// comes near the process that replays.
#pragma once

#include <filesystem>
#include <string>

#include "replay/isa/compiler.h"
#include "replay/isa/gpu_models.h"

namespace strata {

/// The hidden verb. It reads requests from its input and writes a compilation to its output.
inline constexpr const char* compile_verb = "isa-compile";

struct CompileJob {
    const GpuModel* model = nullptr;  ///< null: a device that is there
    std::uint32_t device = 0;         ///< its index in list_devices()
    CompilerTexts texts = CompilerTexts::left;
    std::filesystem::path program;             ///< this one
    const char* const* environment = nullptr;  ///< of the new process but for what chooses its driver; ends with a null
};

/// RADV's descriptions for the Vulkan loader (radeon_icd.*.json), several joined by colons, where the loader would look for them.
/// Fails (device lacks) with the package to install.
Result<std::string> find_radv(const char* const* environment);

/// Fails with what the process said before it ended: device lacks without RADV, device failed when it crashed.
Result<Compilation> compile_elsewhere(const std::vector<PipelineRequest>&, const CompileJob&);

}  // namespace strata
