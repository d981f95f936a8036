// strata spectra: what the tiles of captures need to be lit, and the shading modes that serve them at the least cost.
#include "replay/spectra/spectra.h"

#include <unistd.h>

#include <memory>

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/nearest_name.h"
#include "capture_format/reader.h"
#include "passes/frame_images.h"
#include "passes/technique.h"
#include "replay/cli/given_options.h"
#include "replay/cli/left_out.h"
#include "replay/cli/table_output.h"
#include "replay/cli/verb_options.h"
#include "replay/isa/compile_elsewhere.h"
#include "replay/progress_line.h"

namespace strata {
namespace {

struct SpectraArguments {
    std::vector<std::filesystem::path> captures;
    OpenOptions open;
    ChoiceOptions choices;
    std::string frames, cost, gpu_model, aim = "sum";
    SpectraWish wish;
    std::size_t repeats = 7;
    TableOutput output;
};

Result<const CostSource*> find_cost_source(const std::string& name) {
    std::vector<std::string_view> known;
    for (const CostSource& source : cost_sources()) {
        if (source.name == name) return &source;
        known.push_back(source.name);
    }
    return fail(Fault::usage, "options.not_a_choice", "{option} takes {choices}, not '{value}'{suggestion}", "--cost",
                fmt::format("{}", fmt::join(known, " or ")), name, did_you_mean(name, known));
}

Result<std::unique_ptr<Session>> open_one(const SpectraArguments& options, const std::filesystem::path& capture) {
    OpenOptions one = options.open;
    one.capture = capture;
    return open(one);
}

Result<std::vector<FrameSpectra>> gather(const SpectraArguments& options, const Technique& technique, const Request& base,
                                         const Progress& progress) {
    std::vector<FrameSpectra> gathered;
    std::string why = "nothing is lit";
    LeftOutNotes notes;
    for (std::size_t i = 0; i < options.captures.size(); ++i) {
        const std::filesystem::path& capture = options.captures[i];
        progress("features of " + capture.filename().string(), double(i) / double(options.captures.size()));
        auto session = open_one(options, capture);
        if (!session) return session.error();
        const auto frames = frame_indices(options.frames, (*session)->frame_count());
        if (!frames) return frames.error();
        Request request = base;
        request.choices.use(technique);
        for (const std::size_t frame : *frames) {
            request.variant.frame = frame;
            if (const auto told = notes.tell(**session, request, base.choices); !told) return told.error();
        }
        auto made = gather_spectra(**session, technique, base, *frames);
        if (!made) return made.error();
        if (!made->skipped.empty()) why = made->skipped.front().reason;
        for (FrameSpectra& frame : made->frames) {
            if (frame.tiles.empty()) continue;
            frame.capture = capture.string();
            gathered.push_back(std::move(frame));
        }
    }
    if (gathered.empty()) return fail(Fault::usage, "spectra.no_frame", "no frame has a feature spectrum: {reason}", why);
    return gathered;
}

/// With a GPU and no word on costs, its compiler's.
std::string cost_of(const SpectraArguments& options) {
    if (!options.cost.empty()) return options.cost;
    return options.gpu_model.empty() ? "weights" : "isa";
}

/// Options of another source of costs than the one that is used.
Result<void> check_options(const SpectraArguments& options, const CLI::App& app) {
    const std::string cost = cost_of(options);
    const auto why = fmt::format("--cost is {}", cost);
    const auto models = cost == "isa" ? Result<void>() : check_not_given(app, {"--gpu-model"}, why);
    return !models || cost == "measured" ? models : check_not_given(app, {"--repeats"}, why);
}

Result<const GpuModel*> gpu_of(const SpectraArguments& options) {
    if (options.gpu_model.empty()) return nullptr;
    return find_compiled_gpu_model(options.gpu_model);
}

Result<void> spectra(const SpectraArguments& options) {
    if (const auto fits = check_ending(options.output); !fits) return fits;
    const auto source = find_cost_source(cost_of(options));
    if (!source) return source.error();
    const auto gpu = gpu_of(options);
    if (!gpu) return gpu.error();
    const auto base = request_of(options.choices);
    if (!base) return base.error();
    const auto technique = technique_of_spectra(base->choices);
    if (!technique) return technique.error();
    if (options.choices.uses.empty())
        to_stderr("strata: feature spectra are those of {}, whatever the captures were recorded with\n", (*technique)->name);
    const Progress progress = progress_line();
    auto frames = gather(options, **technique, *base, progress);
    if (!frames) return frames.error();
    CostQuestion question{.technique = **technique,
                          .base = *base,
                          .frames = *frames,
                          .modes = modes_that_matter(*frames),
                          .open = [&](const std::string& capture) { return open_one(options, capture); },
                          .repeats = options.repeats,
                          .progress = progress,
                          .gpu = *gpu};
    if (*gpu)
        question.compile = [&](const std::vector<PipelineRequest>& pipelines) {
            return compile_elsewhere(pipelines, {.model = *gpu, .program = "/proc/self/exe", .environment = environ});
        };
    SpectraWish wish = options.wish;
    wish.aim = options.aim == "worst" ? lighting::Aim::worst : lighting::Aim::sum;
    auto report = find_modes(**source, std::move(question), wish);
    if (!report) return report.error();
    report->technique = *technique;
    report->cost_source = *gpu ? fmt::format("isa, {}", (*gpu)->name) : cost_of(options);
    report->date = date_of_output();
    write_stdout(in_format(printed_format(options.output), *report));
    if (options.output.file.empty()) return {};
    return write_whole_file(options.output.file, in_format(file_format(options.output, OutputFormat::json), *report));
}

std::string help_of_costs() {
    std::string help = "source of a shader variant's cost";
    for (const CostSource& source : cost_sources()) help += fmt::format("; {}: {}", source.name, source.help);
    return help + "; default weights, with --gpu-model isa";
}

}  // namespace

std::function<Result<void>()> declare_spectra(CLI::App& app) {
    const auto options = std::make_shared<SpectraArguments>();
    app.add_option("captures", options->captures, "captures (.strata files); every frame has the same weight")
        ->required()
        ->type_name(input_file);
    add_options(app, options->open.device);
    app.add_flag("--allow-partial", options->open.allow_partial, "read the complete frames of a truncated file");
    add_options(app, options->choices);
    app.add_option("--frames", options->frames, "indices of frames of each capture, like 0,4-8; default all");
    app.add_option("--modes", options->wish.modes, "largest number of shader variants (modes), including the full one; default 8")
        ->check(from_to(1, most_settable_modes));
    app.add_option("--cost", options->cost, help_of_costs());
    app.add_option("--gpu-model", options->gpu_model, "GPU model to compile shader variants for (strata isa lists them)");
    app.add_option("--aim", options->aim,
                   "what to minimize: sum (default), the cost of all frames; worst, the most expensive frame")
        ->check(one_of({"sum", "worst"}));
    app.add_option("--dispatch", options->wish.dispatch, "cost of one more mode per frame, in the unit of --cost; default 0")
        ->check(not_negative());
    app.add_option("--repeats", options->repeats, "timed repeats of each shader variant after a warm-up, default 7")
        ->check(from_to(1, 1000));
    add_formats(app, options->output);
    add_output_file(app, options->output, "also write to this file, in the format of its ending: .json, .csv, .md or .txt");
    return [options, &app] { return check_options(*options, app).and_then([&] { return spectra(*options); }); };
}

}  // namespace strata
