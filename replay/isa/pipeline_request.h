// The pipelines of a plan as a compiler in another process needs them: shaders by name, constants, bindings, attachments. That
// process is this program again, so the shaders themselves are there.
#pragma once

#include <string>
#include <vector>

#include "passes/graph/plan.h"

namespace strata {

struct PipelineRequest {
    std::string label;                ///< the step's shader and the constants it fixes: one shader, a row per mode
    PlannedStep step;                 ///< only what pipelines are made of
    std::vector<ImageRecord> images;  ///< its attachments
};

struct PipelineRequests {
    std::vector<PipelineRequest> pipelines;  ///< no two are equal
    std::vector<std::uint32_t> of_step;      ///< by step of the plan; no_index for steps without shaders
};
PipelineRequests pipelines_of(const Plan&);

std::string as_json(const std::vector<PipelineRequest>&);
/// Shaders must be in the library. Fails (bad input) for what as_json() did not write.
Result<std::vector<PipelineRequest>> pipelines_from_json(const std::string& text, const ShaderLibrary&);

}  // namespace strata
