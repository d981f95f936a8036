// strata record: a scenario's frames go through the Recorder, as an application's would.
#include <memory>

#include <CLI/CLI.hpp>

#include "capture_format/container/picture.h"
#include "capture_format/container/whole_file.h"
#include "capture_format/recorder.h"
#include "captures/scenarios.h"
#include "replay/cli/given_options.h"
#include "replay/cli/verb_options.h"
#include "replay/plural.h"
#include "replay/progress_line.h"

namespace strata {
namespace {

struct RecordArguments {
    std::string scenario, size;
    std::filesystem::path output;
    ScenarioOptions frames;
    RecorderOptions recorder;
    DeviceChoice device;
};

/// Something that must fit into the recorder's budget.
struct Piece {
    std::string name;
    std::uint64_t bytes = 0;
};

Piece piece_of(const std::optional<Texture>& thumbnail) {
    const auto encoded = thumbnail ? encode_picture(*thumbnail) : Result<std::vector<std::byte>>(std::vector<std::byte>());
    return {"the thumbnail", encoded ? encoded->size() : 0};
}

/// Fails with the smallest budget that is enough for the thumbnail and for every frame.
Error too_small(std::uint64_t budget, Piece largest, const Scenario& scenario, const ScenarioOptions& options) {
    for (std::uint32_t index = 0; index < options.frames; ++index)
        if (const std::uint64_t bytes = recorded_bytes(scenario.build(index, options)); bytes > largest.bytes)
            largest = {fmt::format("frame {}", index), bytes};
    return fail(Fault::usage, "record.budget_too_small",
                "--budget is {budget} bytes, and {part} takes {bytes}: pass at least as many", budget, largest.name,
                largest.bytes);
}

Result<void> record(const RecordArguments& options) {
    const auto scenario = find_scenario(options.scenario);
    if (!scenario) return scenario.error();
    ScenarioOptions wanted = options.frames;
    wanted.width = (*scenario)->width;
    wanted.height = (*scenario)->height;
    if (!options.size.empty()) {
        const auto extent = extent_of(options.size);
        if (!extent) return extent.error();
        std::tie(wanted.width, wanted.height) = *extent;
    }
    const Progress progress = progress_line();
    progress("thumbnail", 0);
    const auto thumbnail = make_thumbnail((*scenario)->build(0, wanted), options.device);
    if (!thumbnail) return thumbnail.error();
    const std::uint64_t budget = options.recorder.budget_bytes;
    const Piece first = piece_of(*thumbnail);
    if (first.bytes > budget) return too_small(budget, first, **scenario, wanted);
    const std::filesystem::path output =
        options.output.empty() ? std::filesystem::path(options.scenario + ".strata") : options.output;
    auto file = WholeFile::begin(output);
    if (!file) return file.error();
    auto recorder = file->opened_by([&](const std::filesystem::path& path) {
        return Recorder::create(path, fmt::format("scenario {} seed {}", options.scenario, wanted.seed), options.recorder);
    });
    if (!recorder) return recorder.error();
    if (*thumbnail)
        if (const auto done = recorder->thumbnail(**thumbnail); !done) return done;
    for (std::uint32_t index = 0; index < wanted.frames; ++index) {
        show_frame(progress, index, wanted.frames);
        Frame frame = (*scenario)->build(index, wanted);
        if (recorded_bytes(frame) > budget) return too_small(budget, first, **scenario, wanted);
        if (const auto done = recorder->record(std::move(frame)); !done) return done;
    }
    if (const auto done = recorder->finish(); !done) return done;
    if (const auto done = file->commit(); !done) return done;
    to_stderr("recorded {} of {} at {} x {} into {}\n", plural(wanted.frames, "frame"), options.scenario, wanted.width,
              wanted.height, output.string());
    return {};
}

}  // namespace

std::function<Result<void>()> declare_record(CLI::App& app) {
    const auto options = std::make_shared<RecordArguments>();  // lives as long as the parsed command line
    app.add_option("scenario", options->scenario, "name of a scenario (strata list --scenarios)")->required();
    app.add_option("-o,--output", options->output, "capture to write; default SCENARIO.strata")->type_name(output_file);
    app.add_option("--frames", options->frames.frames, "number of frames")->check(from_to(1, 100000));
    app.add_option("--size", options->size, "extent as WIDTHxHEIGHT; default: the scenario's own");
    app.add_option("--samples", options->frames.samples, "samples per pixel")->check(one_or_four());
    app.add_option("--seed", options->frames.seed, "seed of the random numbers");
    app.add_option("--budget", options->recorder.budget_bytes,
                   "largest memory for frames waiting to be written, like 64MiB; every frame must fit")
        ->transform(CLI::AsSizeValue(/*kb_is_1000=*/false));
    app.add_option("--gpu", options->device.gpu, "device that renders the thumbnail, by index or part of its name");
    return [options] { return record(*options); };
}

}  // namespace strata
