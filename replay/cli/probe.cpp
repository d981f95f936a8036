// strata probe: the fragments of one pixel, and T(z) of every technique beside the exact step function.
#include "replay/probe/probe.h"
#include "replay/progress_line.h"

#include <charconv>
#include <memory>

#include <CLI/CLI.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/reader.h"
#include "replay/cli/given_options.h"
#include "replay/cli/left_out.h"
#include "replay/cli/table_output.h"
#include "replay/cli/verb_options.h"

namespace strata {
namespace {

struct ProbeArguments {
    OpenOptions open;
    ChoiceOptions choices;
    std::string at, axis = "log";
    std::uint32_t sample = 0;
    std::size_t frame = 0;
    ProbeOptions probe;
    std::filesystem::path output;
    TableOutput printed;
};

Result<PixelAt> pixel_of(const std::string& text, std::uint32_t sample) {
    PixelAt at{.sample = sample};
    const char* end = text.data() + text.size();
    const auto [comma, problem] = std::from_chars(text.data(), end, at.x);
    if (problem == std::errc() && comma != end && *comma == ',') {
        const auto [rest, problem_y] = std::from_chars(comma + 1, end, at.y);
        if (problem_y == std::errc() && rest == end) return at;
    }
    return fail(Fault::usage, "options.malformed", "{option} takes a pixel like 80,45, not '{value}'", "--at", text);
}

/// "folder/name" of the files, from what was asked for or from the capture and the pixel.
std::filesystem::path stem_of(const ProbeArguments& options, PixelAt at) {
    if (!options.output.empty()) return options.output;
    return fmt::format("{}.f{:04}.x{}.y{}", options.open.capture.stem().string(), options.frame, at.x, at.y);
}

Result<void> write_files(const std::filesystem::path& stem, const Probe& made) {
    if (stem.has_parent_path())
        if (const auto folder = make_folder(stem.parent_path()); !folder) return folder;
    const std::pair<const char*, std::string> files[] = {
        {".json", as_json(made)}, {".csv", curves_csv(made)}, {".svg", as_svg(made)}};
    for (const auto& [extension, text] : files) {
        const std::filesystem::path path = stem.string() + extension;
        if (const auto written = write_whole_file(path, text); !written) return written;
        to_stderr("wrote {}\n", path.string());
    }
    return {};
}

Result<void> run_probe(const ProbeArguments& options) {
    const auto at = pixel_of(options.at, options.sample);
    if (!at) return at.error();
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->variant.frame = options.frame;
    auto session = open(options.open);
    if (!session) return session.error();
    if (const auto told = LeftOutNotes().tell(**session, *request); !told) return told;
    ProbeOptions wanted = options.probe;
    wanted.axis = options.axis == "linear" ? DepthAxis::linear : DepthAxis::logarithmic;
    const Progress progress = progress_line();
    progress("replaying the frame with every technique", 0);
    auto made = probe(**session, *request, *at, wanted);
    progress("", 1);
    if (!made) return made.error();
    made->capture_id = (*session)->capture_id();
    made->capture_name = options.open.capture.filename().string();
    made->date = date_of_output();
    write_stdout(in_format(printed_format(options.printed), *made));
    return write_files(stem_of(options, *at), *made);
}

}  // namespace

std::function<Result<void>()> declare_probe(CLI::App& app) {
    const auto options = std::make_shared<ProbeArguments>();
    add_options(app, options->open);
    add_options(app, options->choices);
    app.add_option("--at", options->at, "pixel as x,y from the top left corner")->required();
    app.add_option("--sample", options->sample, "index of the sample in the pixel, default 0")->check(sample_index());
    app.add_option("--frame", options->frame, "index of the frame, default 0");
    app.add_option("--techniques", options->probe.variants,
                   "transparency techniques with their settings, like 'moments kind=power6,wavelet rank=3'; default: all")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--axis", options->axis, "scale of the depth axis: log (default) or linear")->check(one_of({"log", "linear"}));
    app.add_option("--depths", options->probe.samples, "number of depths at which transmittance is evaluated, default 512")
        ->check(from_to(2, most_probe_depths));
    app.add_option("--from", options->probe.from,
                   "nearest depth at which transmittance is evaluated, in meters; default: just in front of the first fragment")
        ->check(positive());
    app.add_option("--to", options->probe.to,
                   "farthest depth at which transmittance is evaluated, in meters; default: just behind the last fragment")
        ->check(positive());
    app.add_option("-o,--output", options->output,
                   "path of the .json, .csv and .svg without extension; default: capture.f0000.x0.y0");
    add_formats(app, options->printed);
    return [options] { return run_probe(*options); };
}

}  // namespace strata
