// strata isa: every pipeline of a frame through the compiler of a GPU that need not be there.
#include <unistd.h>

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>

#include "capture_format/whole_file.h"
#include "replay/cli/verb_options.h"
#include "replay/counted.h"
#include "replay/isa/compile_elsewhere.h"
#include "replay/isa/isa_report.h"

namespace strata {
namespace {

struct Options {
    OpenOptions open;
    ChoiceOptions choices;
    std::vector<std::string> models;
    std::size_t frame = 0;
    std::filesystem::path dump;
    bool json = false, no_run = false;
};

/// A null stands for the device itself.
Result<std::vector<const GpuModel*>> models_of(const Options& options) {
    std::vector<const GpuModel*> models;
    for (const std::string& name : options.models) {
        const auto found = find_gpu_model(name);
        if (!found) return found.error();
        if ((*found)->family.empty())
            return fail(Fault::usage, "RADV does not compile for {}; choose one with --gpu and leave --gpu-model away", name);
        models.push_back(*found);
    }
    if (models.empty()) models.push_back(nullptr);
    return models;
}

/// "03_lighting_shade.comp_features=0x1f.navi21.compute": the pipeline of that number, in a name without folders.
std::string file_name(std::size_t number, const std::string& label, const std::string& rest) {
    std::string made = fmt::format("{:02}_{}.{}", number, label, rest);
    std::ranges::replace_if(
        made, [](char c) { return c == '/' || c == ' ' || c == '+'; }, '_');
    return made;
}

/// What was compiled, one file per program.
Result<void> dump(const Options& options, const std::string& gpu, const Compilation& made, const PipelineRequests& requests) {
    if (const auto folder = make_folder(options.dump); !folder) return folder;
    std::size_t written = 0, without_assembly = 0;
    for (std::size_t i = 0; i < made.pipelines.size(); ++i)
        for (const Executable& executable : made.pipelines[i].executables) {
            const CompilerText* code = executable.code();
            if (!code) continue;
            const bool is_ir = code->name == "ACO IR";
            const std::string rest = fmt::format("{}.{}.{}", gpu, executable.stage, is_ir ? "aco" : "s");
            const auto path = options.dump / file_name(i, requests.pipelines[i].label, rest);
            if (const auto done = write_whole_file(path, code->text); !done) return done;
            ++written;
            without_assembly += is_ir;
        }
    fmt::print(stderr, "wrote {} for {} to {}\n", counted(written, "program"), gpu, options.dump.string());
    if (without_assembly > 0)
        fmt::print(stderr, "strata: the driver has no disassembler for {}: what it writes is the compiler's last form, ACO IR\n",
                   gpu);
    return {};
}

/// What of the frame must be run to be known: indirect dispatches and draws.
bool needs_a_run(const Plan& plan) {
    return std::ranges::any_of(plan.steps, [](const PlannedStep& planned) {
        const auto* compute = std::get_if<ComputeWork>(&planned.step.work);
        return (compute && compute->arguments) || std::holds_alternative<DrawWork>(planned.step.work);
    });
}

Result<IsaReport> describe_frame(Session& session, const Request& request, const Options& options) {
    const auto frame = session.frame(request.frame);
    if (!frame) return frame.error();
    return IsaReport{.capture = options.open.capture.filename().string(),
                     .frame = request.frame,
                     .width = frame->view.width,
                     .height = frame->view.height,
                     .samples = request.samples ? request.samples : frame->view.samples};
}

Result<void> run_isa(const Options& options) {
    const auto models = models_of(options);
    if (!models) return models.error();
    if (options.open.capture.empty()) {
        fmt::print("{}", gpu_models_text());
        return {};
    }
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->frame = options.frame;
    auto session = open(options.open);
    if (!session) return session.error();
    const auto planned = (*session)->plan(*request);
    if (!planned) return planned.error();
    const PipelineRequests requests = pipelines_of(planned->plan);
    const DeviceInfo& device = (*session)->device();
    std::vector<Compilation> made;  // before the frame is run: what cannot be compiled is known at once
    for (const GpuModel* model : *models) {
        auto compiled =
            compile_elsewhere(requests.pipelines, {.model = model,
                                                   .device = model ? 0 : device.index,
                                                   .texts = options.dump.empty() ? CompilerTexts::left : CompilerTexts::kept,
                                                   .program = "/proc/self/exe",
                                                   .environment = environ});
        if (!compiled) return compiled.error();
        made.push_back(*std::move(compiled));
    }
    auto counts =
        options.no_run || !needs_a_run(planned->plan) ? Result<StepCounts>(StepCounts{}) : count_steps(**session, *request);
    if (!counts) return counts.error();
    auto report = describe_frame(**session, *request, options);
    if (!report) return report.error();
    const Counting counting{planned->plan, *counts, !device.software};
    for (std::size_t i = 0; i < made.size(); ++i) {
        const GpuModel* model = (*models)[i] ? (*models)[i] : gpu_model_of(made[i].device);
        report->gpus.push_back(isa_of_gpu(model, made[i], requests, passes_of(counting, requests)));
        if (options.dump.empty()) continue;
        if (const auto done = dump(options, report->gpus.back().name, made[i], requests); !done) return done;
    }
    fmt::print("{}", options.json ? as_json(*report) : as_text(*report));
    return {};
}

}  // namespace

std::function<Result<void>()> declare_isa(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    add_options(app, options->open);
    app.get_option("capture")->required(false)->description("a .strata file; without one, the GPU models that are known");
    add_options(app, options->choices);
    app.add_option("--gpu-model", options->models,
                   "a,b: GPUs to compile for, without hardware (Mesa's RADV); default: the device itself, where it tells")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--frame", options->frame, "which frame, default 0");
    app.add_option("--dump", options->dump, "folder for the disassembly of every program, made when missing");
    app.add_flag("--no-run", options->no_run, "do not run the frame to count what indirect dispatches and draws invoke");
    app.add_flag("--json", options->json, "one JSON object on stdout");
    return [options] { return run_isa(*options); };
}

}  // namespace strata
