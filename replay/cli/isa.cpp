// strata isa: every pipeline of a frame through the compiler of a GPU that need not be there.
#include <oneapi/tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "passes/technique.h"
#include "replay/cli/given_options.h"
#include "replay/cli/left_out.h"
#include "replay/cli/run_json.h"
#include "replay/cli/table_output.h"
#include "replay/cli/verb_options.h"
#include "replay/isa/compile_elsewhere.h"
#include "replay/isa/isa_report.h"
#include "replay/plural.h"
#include "replay/progress_line.h"

namespace strata {
namespace {

struct IsaArguments {
    OpenOptions open;
    ChoiceOptions choices;
    std::vector<std::string> models;
    std::size_t frame = 0;
    std::filesystem::path dump, tiles;
    TableOutput output;
    bool no_run = false;
};

/// A null stands for the device itself.
Result<std::vector<const GpuModel*>> models_of(const IsaArguments& options) {
    std::vector<const GpuModel*> models;
    for (const std::string& name : options.models) {
        const auto found = find_compiled_gpu_model(name);
        if (!found) return found.error();
        if (std::ranges::count(models, *found) > 0)
            return fail(Fault::usage, "options.value_twice", "{option} gives '{value}' twice", "--gpu-model", name);
        models.push_back(*found);
    }
    if (models.empty()) models.push_back(nullptr);
    return models;
}

/// "03_lighting_shade.comp_features=0x1f.navi21.compute": the pipeline of that number, in a name without folders. File systems
/// take 255 bytes: constants that are more than fit are in the report.
std::string file_name(std::size_t number, const std::string& label, const std::string& rest) {
    constexpr std::size_t most = 160;
    std::string made = fmt::format("{:02}_{}.{}", number, label.substr(0, most), rest);
    std::ranges::replace_if(
        made, [](char c) { return c == '/' || c == ' ' || c == '+'; }, '_');
    return made;
}

/// What was compiled, one file per program.
Result<void> dump(const IsaArguments& options, const std::string& gpu, const Compilation& made,
                  const PipelineRequests& requests) {
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
    to_stderr("wrote {} for {} to {}\n", plural(written, "program"), gpu, options.dump.string());
    if (without_assembly > 0)
        to_stderr("strata: the driver has no disassembler for {} and writes the compiler's last intermediate form, ACO IR\n",
                  gpu);
    return {};
}

/// Whether `--dump` can be followed: before anything is compiled.
Result<void> check_dump(const IsaArguments& options) {
    if (options.dump.empty()) return {};
    if (const auto folder = make_folder(options.dump); !folder) return folder;
    const auto tried = WholeFile::begin(options.dump / "tried");
    return tried ? Result<void>() : Result<void>(tried.error());
}

/// Whether `--tiles` can be followed: before anything is compiled.
Result<void> check_tiles(const IsaArguments& options, std::span<const GpuModel* const> models) {
    if (options.tiles.empty()) return {};
    const std::string kind = options.tiles.extension().string();
    if (kind != ".exr" && kind != ".png")
        return fail(Fault::usage, "output.unknown_ending", "tiles are written as {endings}, not as '{file}'", ".exr or .png",
                    options.tiles.filename().string());
    if (models.size() > 1)
        return fail(Fault::usage, "isa.tiles_of_one_gpu", "--tiles shows one GPU, not {gpus}; pass one --gpu-model",
                    models.size());
    return {};
}

/// Whose tiles are joined with what.
struct TilesOfGpu {
    const Technique& technique;
    IsaOfGpu& gpu;
    const PipelineRequests& requests;
};

/// Joins the tiles of the frame with what was compiled, and writes their picture.
Result<void> add_tiles(Session& session, Request request, const IsaArguments& options, TilesOfGpu of) {
    request.outputs = outputs_of_variants(of.technique);
    request.once = true;
    const auto run = session.run(request);
    if (!run) return run.error();
    auto waves = waves_of_tiles({of.technique, *run, of.gpu, of.requests});
    if (!waves) return waves.error();
    of.gpu.tiles = *std::move(waves);
    const TileWaves& made = *of.gpu.tiles;
    if (options.tiles.extension() == ".png") {
        const Canvas canvas = tile_waves_picture(made, *of.gpu.model);
        const Extent extent{static_cast<std::uint32_t>(canvas.width()), static_cast<std::uint32_t>(canvas.height()), 1};
        return write_png(options.tiles, extent, std::as_bytes(std::span(canvas.pixels())));
    }
    Metadata metadata = provenance(session, request, *run);
    metadata["strata.gpu_model"] = of.gpu.name;
    return write_exr(options.tiles, {{"waves per SIMD", made.picture}}, metadata);
}

Result<IsaReport> describe_frame(Session& session, const Request& request, const IsaArguments& options) {
    return session.frame(request.variant.frame).and_then([&](auto& frame) {
        return IsaReport{.capture = options.open.capture.filename().string(),
                         .frame = request.variant.frame,
                         .width = frame.view.width,
                         .height = frame.view.height,
                         .samples = request.variant.samples ? request.variant.samples : frame.view.samples};
    });
}

/// The compilations of one plan, in the order of the models; of several models at once.
Result<std::vector<Compilation>> compile_all(const IsaArguments& options, const PipelineRequests& requests,
                                             std::span<const GpuModel* const> models, std::uint32_t device) {
    std::vector<Result<Compilation>> compiled(models.size(), Compilation{});
    oneapi::tbb::parallel_for(std::size_t{0}, models.size(), [&](std::size_t i) {
        compiled[i] =
            compile_elsewhere(requests.pipelines, {.model = models[i],
                                                   .device = models[i] ? 0 : device,
                                                   .texts = options.dump.empty() ? CompilerTexts::left : CompilerTexts::kept,
                                                   .program = "/proc/self/exe",
                                                   .environment = environ});
    });
    std::vector<Compilation> made;
    for (Result<Compilation>& one : compiled) {
        if (!one) return one.error();
        made.push_back(*std::move(one));
    }
    return made;
}

/// Who shades the tiles that are asked for, which the request then uses; null where none are.
Result<const Technique*> shader_of_tiles(const IsaArguments& options, Request& request) {
    if (options.tiles.empty()) return nullptr;
    const auto technique = technique_of_variants(request.choices);
    if (technique) request.choices.use(**technique);
    if (technique && options.choices.uses.empty())
        to_stderr("strata: --tiles are those of {}, whatever the capture was recorded with\n", (*technique)->name);
    return technique;
}

Result<void> report_frame(const IsaArguments& options, std::span<const GpuModel* const> models) {
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->variant.frame = options.frame;
    const ChoiceChanges asked = request->choices;
    const auto shader = shader_of_tiles(options, *request);
    if (!shader) return shader.error();
    auto session = open(options.open);
    if (!session) return session.error();
    if (const auto told = LeftOutNotes().tell(**session, *request, asked); !told) return told;
    const auto planned = (*session)->plan(*request);
    if (!planned) return planned.error();
    const PipelineRequests requests = pipelines_of(planned->plan);
    const DeviceInfo& device = (*session)->device();
    const Progress progress = progress_line();
    progress("compiling pipelines", 0);
    // Before the frame is run: what cannot be compiled is known at once.
    const auto made = compile_all(options, requests, models, device.index);
    if (!made) return made.error();
    progress("running the frame", .5);
    const auto counts = options.no_run ? Result<StepCounts>(StepCounts{}) : count_steps(**session, *request);
    if (!counts) return counts.error();
    auto report = describe_frame(**session, *request, options);
    if (!report) return report.error();
    const Counting counting{planned->plan, *counts, !device.software};
    for (std::size_t i = 0; i < made->size(); ++i) {
        const Compilation& compiled = (*made)[i];
        const GpuModel* model = models[i] ? models[i] : gpu_model_of(compiled.device);
        IsaOfGpu& gpu = report->gpus.emplace_back(isa_of_gpu(model, compiled, requests, isa_steps_of(counting, requests)));
        if (*shader)
            if (const auto done = add_tiles(**session, *request, options, {**shader, gpu, requests}); !done) return done;
        if (options.dump.empty()) continue;
        if (const auto done = dump(options, gpu.name, compiled, requests); !done) return done;
    }
    report->capture_id = (*session)->capture_id();
    report->date = date_of_output();
    write_stdout(in_format(printed_format(options.output), *report));
    return {};
}

Result<void> run_isa(const IsaArguments& options, const CLI::App& app) {
    const auto models = models_of(options);
    if (!models) return models.error();
    if (options.open.capture.empty()) {
        const auto listing =
            check_not_given(app,
                            {"--gpu", "--without", "--validation", "--memory-budget", "--allow-partial", "--use", "--set",
                             "--force", "--samples", "--gpu-model", "--frame", "--dump", "--no-run", "--tiles"},
                            "without a capture the known GPU models are listed");
        if (!listing) return listing;
        write_stdout(in_format(printed_format(options.output), GpuModels{.date = date_of_output()}));
        return {};
    }
    if (const auto fine = check_tiles(options, *models); !fine) return fine;
    if (const auto fine = check_dump(options); !fine) return fine;
    return report_frame(options, *models);
}

}  // namespace

std::function<Result<void>()> declare_isa(CLI::App& app) {
    const auto options = std::make_shared<IsaArguments>();
    add_options(app, options->open);
    app.get_option("capture")->required(false)->description(
        "capture (.strata file); without one, the known GPU models are listed");
    add_options(app, options->choices);
    app.add_option(
           "--gpu-model", options->models,
           "GPU models to compile for without hardware, as a,b (Mesa's RADV); default: the device, if it reports statistics")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--frame", options->frame, "index of the frame, default 0");
    app.add_option("--dump", options->dump, "write the disassembly of every shader to this folder; it is created if missing")
        ->type_name(output_folder);
    auto* no_run = app.add_flag("--no-run", options->no_run,
                                "do not run the frame; invocations of indirect dispatches and draws stay unknown");
    app.add_option(
           "--tiles", options->tiles,
           "write waves per SIMD by screen tile, for techniques with several shader variants: .png in colors, .exr as numbers")
        ->excludes(no_run)
        ->type_name(output_file);
    add_formats(app, options->output);
    return [options, &app] { return run_isa(*options, app); };
}

}  // namespace strata
