// What compilers make of a frame's pipelines, held against our own arithmetic, and what that models of the frame's times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "replay/isa/compiled_pipeline.h"
#include "replay/isa/occupancy.h"
#include "replay/isa/pipeline_request.h"
#include "replay/isa/tile_waves.h"
#include "replay/session/step_counts.h"
#include "replay/tables/sheet.h"

namespace strata {

/// A program of a pipeline. Numbers are the compiler's; what it does not say is absent.
struct IsaProgram {
    std::size_t pipeline = 0;  ///< in PipelineRequests::pipelines
    std::string label, stage;
    std::uint32_t wave_lanes = 0, group_threads = 0;
    std::optional<double> registers, scalar_registers, lds_bytes, spilled, scratch_bytes, code_bytes, instructions, latency,
        inverse_throughput;
    std::optional<Occupancy> occupancy;            ///< ours; of GPUs in our table
    std::optional<double> stated, stated_by_rule;  ///< RADV's waves per SIMD, and what its own rule gives (stated_by_radv)
};

/// A step of the frame.
struct IsaStep {
    Scope scope;
    std::string name, label;  ///< the label is its pipeline's
    std::size_t pipeline = 0;
    std::optional<std::uint64_t> invocations;
    std::string counted_by;  ///< "dispatch", "pixels", "rasterizer", "counter", "device", or "unknown"
    std::optional<double> modeled_ms;
};

/// One GPU's part.
struct IsaOfGpu {
    std::string name;                 ///< as asked for, or the device's
    const GpuModel* model = nullptr;  ///< null: a device that is not in our table
    std::string device, driver;
    std::vector<IsaProgram> programs;
    std::vector<IsaStep> steps;
    std::optional<double> modeled_ms;  ///< of the steps that have a time; nothing where none has
    std::vector<std::string> notes;    ///< pipelines that did not compile, numbers that contradict each other
    std::optional<TileWaves> tiles;    ///< when asked for
};

struct IsaReport {
    std::string capture;
    std::string capture_id = {}, date = {};  ///< the caller's; utc_date()
    std::size_t frame = 0;
    std::uint32_t width = 0, height = 0, samples = 1;
    std::vector<IsaOfGpu> gpus;
};

/// invocations / 64 x inverse throughput / (SIMDs x clock): what the report calls modeled.
double modeled_ms(const GpuModel&, std::uint64_t invocations, double inverse_throughput);

/// How often a step ran its compute or fragment shader, as far as that is known. `counts` may be empty: the frame was not run.
struct Counting {
    const Plan& plan;
    const StepCounts& counts;
    bool device_counts_fragments = false;  ///< not on a CPU driver: its count is wrong
};
struct StepInvocations {
    std::optional<std::uint64_t> count;
    std::string counted_by = "unknown";  ///< as in IsaStep
};
StepInvocations invocations_of(const Counting&, std::size_t step);
std::vector<IsaStep> isa_steps_of(const Counting&, const PipelineRequests&);

IsaOfGpu isa_of_gpu(const GpuModel*, const Compilation&, const PipelineRequests&, std::vector<IsaStep>);

Page page_of(const IsaReport&);
std::string as_text(const IsaReport&);
std::string as_json(const IsaReport&);
/// The programs, steps and tiles of every GPU as one table.
std::string as_csv(const IsaReport&);

/// Every model of the table.
struct GpuModels {
    std::span<const GpuModel> models = gpu_models();
    std::string date = {};  ///< utc_date(); the caller's
};
Page page_of(const GpuModels&);
std::string as_text(const GpuModels&);
std::string as_json(const GpuModels&);
std::string as_csv(const GpuModels&);

}  // namespace strata
