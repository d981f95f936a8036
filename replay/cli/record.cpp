// strata record: a scenario's frames go through the Recorder, as an application's would.
#include <memory>

#include <CLI/CLI.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/recorder.h"
#include "captures/scenarios.h"
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
    const std::filesystem::path output =
        options.output.empty() ? std::filesystem::path(options.scenario + ".strata") : options.output;
    auto file = WholeFile::begin(output);
    if (!file) return file.error();
    auto recorder =
        Recorder::create(file->temporary(), fmt::format("scenario {} seed {}", options.scenario, wanted.seed), options.recorder);
    if (!recorder) return recorder.error();
    const Progress progress = progress_line();
    for (std::uint32_t index = 0; index < wanted.frames; ++index) {
        show_frame(progress, index, wanted.frames);
        Frame frame = (*scenario)->build(index, wanted);
        if (index == 0)
            if (const auto done = add_thumbnail(*recorder, frame, options.device); !done) return done;
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
    app.add_option("scenario", options->scenario, "see strata list --scenarios")->required();
    app.add_option("-o,--output", options->output, "capture to write; default SCENARIO.strata");
    app.add_option("--frames", options->frames.frames, "how many frames")->check(CLI::Range(1, 100000));
    app.add_option("--size", options->size, "WIDTHxHEIGHT instead of the scenario's own");
    app.add_option("--samples", options->frames.samples, "samples per pixel")->check(CLI::IsMember({1, 4}));
    app.add_option("--seed", options->frames.seed, "of everything random");
    app.add_option("--budget", options->recorder.budget_bytes, "most memory for frames that wait to be written, as 64MiB")
        ->transform(CLI::AsSizeValue(true));
    app.add_option("--gpu", options->device.gpu, "device that makes the thumbnail");
    return [options] { return record(*options); };
}

}  // namespace strata
