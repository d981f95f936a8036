// strata report: error against time for every technique of a stage.
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include <CLI/CLI.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/reader.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/cli/given_options.h"
#include "replay/cli/left_out.h"
#include "replay/cli/report_needs.h"
#include "replay/cli/report_request.h"
#include "replay/cli/table_output.h"
#include "replay/cli/verb_options.h"
#include "replay/progress_line.h"
#include "replay/report/hard_cases.h"
#include "replay/report/page/page.h"
#include "replay/report/report_columns.h"
#include "replay/report/variants.h"
#include "replay/report/warnings.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

/// Asks for a stop after so many minutes, and when another stop is requested.
class Deadline {
public:
    Deadline(std::optional<double> minutes, const std::stop_token& other) : on_other_(other, Ask{source_}) {
        if (!minutes) return;
        waiting_ = std::jthread([source = source_, seconds = *minutes * 60](const std::stop_token& is_over) mutable {
            std::mutex mutex;
            std::condition_variable_any never;
            std::unique_lock lock(mutex);
            never.wait_for(lock, is_over, std::chrono::duration<double>(seconds), [] { return false; });
            if (!is_over.stop_requested()) source.request_stop();
        });
    }
    std::stop_token token() const { return source_.get_token(); }

private:
    struct Ask {
        std::stop_source source;
        void operator()() { source.request_stop(); }
    };
    std::stop_source source_;
    std::stop_callback<Ask> on_other_;
    std::jthread waiting_;
};

std::string written(OutputFormat format, std::span<const Report> made) {
    if (made.size() == 1)
        return format == OutputFormat::html  ? as_html(made[0])
               : format == OutputFormat::svg ? as_svg(made[0])
                                             : in_format(format, made[0]);
    const Pool pool = pooled(made);
    if (format == OutputFormat::html) return as_html(made, pool);
    if (format == OutputFormat::svg) return as_svg(made, pool);
    if (format == OutputFormat::json) return as_json(made, pool);
    if (format == OutputFormat::csv) return as_csv(made, pool);
    const Page page = page_of(made, pool);
    return format == OutputFormat::markdown ? as_markdown(page) : as_text(page);
}

/// "64". A capture behind --flicker would be taken for its number.
std::string problem_of_positions(std::string& text) {
    std::uint32_t count = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (problem == std::errc() && end == text.data() + text.size() && count >= 2 && count <= 10000) return {};
    throw RefusedValue{fail(Fault::usage, "options.out_of_range",
                            "takes {low} to {high} positions, not '{value}'; write captures before it", 2, 10000, text)};
}

Result<void> report_hard_cases(const ReportArguments& options) {
    auto rows = variants({.stage = Stage::transparency});
    if (!rows) return rows.error();
    if (!options.variants) std::erase_if(*rows, [](const Variant& row) { return !row.settings.empty(); });
    const StopAtSignal signal;
    return measure_hard_cases(options.open.device, *rows, progress_line(), signal.token()).and_then([&](auto& made) {
        made.date = date_of_output();
        const OutputFormat format = file_format(options.output, OutputFormat::text);
        const auto done = write_text(options.output, format == OutputFormat::html ? as_html(made) : in_format(format, made));
        return done && !made.stopped.empty() ? Result<void>(fail(Fault::stopped, "session.stopped", "{progress}", made.stopped))
                                             : done;
    });
}

/// Captures as they were named, and those of folders by name. Fails for a folder without any.
Result<std::vector<std::filesystem::path>> captures_of(const std::vector<std::filesystem::path>& named) {
    std::vector<std::filesystem::path> captures;
    for (const std::filesystem::path& path : named) {
        std::error_code problem;
        if (!std::filesystem::is_directory(path, problem)) {
            captures.push_back(path);
            continue;
        }
        std::vector<std::filesystem::path> inside;
        for (const auto& entry : std::filesystem::directory_iterator(path, problem))
            if (entry.path().extension() == ".strata") inside.push_back(entry.path());
        if (inside.empty())
            return fail(Fault::bad_input, "report.no_capture_in_folder", "the folder {folder} holds no capture (.strata file)",
                        path.string());
        std::ranges::sort(inside);
        captures.insert(captures.end(), inside.begin(), inside.end());
    }
    return captures;
}

/// The reports of a run of the verb.
struct Measured {
    std::vector<Report> reports;
    std::size_t captures = 0;  ///< of which all frames are there
    LeftOutNotes notes;
};

/// A report of each frame; fails as make_report() does.
Result<void> measure_frames(Session& session, ReportRequest request, std::span<const std::size_t> frames, const std::string& name,
                            Measured& measured) {
    const Progress progress = progress_line();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (frames.size() > 1) show_frame(progress, i, frames.size());
        request.base.variant.frame = frames[i];
        if (const auto told = measured.notes.tell(session, request.base); !told) return told;
        auto report = make_report(session, request, progress);
        if (!report) return report.error();
        report->capture_name = name;
        report->date = date_of_output();
        measured.reports.push_back(*std::move(report));
        if (!measured.reports.back().stopped.empty()) break;
    }
    return {};
}

/// Fails (over tolerance) where limits were asked for that nothing keeps.
Result<void> check_answered(std::span<const Report> made) {
    if (made.size() > 1) {
        const Pool pool = pooled(made);
        if (!is_unanswered(pool)) return {};
        return fail(Fault::over_tolerance, "report.no_pooled_answer",
                    "no technique keeps the limits that are asked for over {frames}", frames_text(pool));
    }
    const Report& only = made.front();
    if (!is_unanswered(only)) return {};
    if (changes_too_little(only))
        return fail(Fault::over_tolerance, "report.too_few_pixels",
                    "the stage changes fewer than {fewest} pixels of {capture}: too few for an answer", fewest_pixels,
                    only.capture_name);
    return fail(Fault::over_tolerance, "report.no_answer", "no technique on {capture} keeps the limits that are asked for",
                only.capture_name);
}

/// --needs: techniques are not compared, so what compares them does not apply.
Result<void> report_needs(const ReportArguments& options, std::span<const std::filesystem::path> captures, const CLI::App& app) {
    const auto fits = check_not_given(app,
                                      {"--stage", "--techniques", "--defaults", "--error", "--error-at", "--metric", "--within",
                                       "--memory", "--cost", "--sweep", "--minutes", "--flicker"},
                                      "--needs compares no techniques");
    if (!fits) return fits;
    return strata::report_needs(NeedsArguments{captures, options.open, options.choices, options.frames, options.eye,
                                               options.repeats.value_or(3), options.output});
}

Result<void> report(const ReportArguments& options, const CLI::App& app) {
    TableOutput output = options.output;
    output.may_be_page = !options.needs;
    output.may_be_plot = !options.hard_cases && !options.needs;
    if (const auto fits = check_ending(output); !fits) return fits;
    const OutputFormat format = file_format(output, OutputFormat::text);
    if (options.hard_cases) {
        const auto fits = check_not_given(app,
                                          {"--allow-partial", "--use", "--set", "--force", "--samples", "--stage", "--techniques",
                                           "--defaults", "--error", "--error-at", "--metric", "--within", "--memory", "--cost",
                                           "--sweep", "--frames", "--repeats", "--minutes", "--flicker"},
                                          "--hard-cases brings frames and settings of its own");
        return fits ? report_hard_cases(options) : fits;
    }
    if (options.captures.empty())
        return fail(Fault::usage, "options.missing", "a {option} is required; --hard-cases builds frames and needs none",
                    "capture");
    const auto captures = captures_of(options.captures);
    if (options.needs) return captures ? report_needs(options, *captures, app) : captures.error();
    const auto wanted = request_of(options);
    if (!wanted) return wanted.error();
    if (!captures) return captures.error();
    ReportRequest request = *wanted;
    request.wants_pictures = format == OutputFormat::html;
    request.on_row = [](const Measurement& row, std::size_t place, std::size_t of) {
        const std::string row_label = label(row.technique, row.settings);
        if (!row.accuracy.not_supported.empty()) return to_stderr("strata: {} of {}  {}: not supported\n", place, of, row_label);
        const RankingError ranking = ranking_error(row);
        const std::string time = row.time ? fmt::format("time {}", short_number(row.time->median))
                                          : fmt::format("{} ms", short_number(row.stage_ms.median));
        to_stderr("strata: {} of {}  {}: {} {}, {}\n", place, of, row_label, ranking.name,
                  ranking.text(ranking_metric(row).value), time);
    };
    const StopAtSignal signal;
    const Deadline deadline(options.minutes, signal.token());
    Measured measured;
    for (const std::filesystem::path& capture : *captures) {
        OpenOptions one = options.open;
        one.capture = capture;
        auto session = open(one);
        if (!session) return session.error();
        const auto frames = frame_indices(options.frames, (*session)->frame_count());
        if (!frames) return frames.error();
        (*session)->stop_when(deadline.token());
        const auto done = measure_frames(**session, request, *frames, capture.filename().string(), measured);
        if (!done && done.error().fault == Fault::stopped && !measured.reports.empty()) break;
        if (!done && done.error().fault == Fault::stopped && !signal.token().stop_requested())
            return fail(Fault::usage, "report.no_row_in_time",
                        "no row was measured within {minutes} minutes; pass more --minutes", *options.minutes);
        if (!done) return done.error();
        measured.captures += 1;
        if (deadline.token().stop_requested()) break;
    }
    const std::vector<Report>& made = measured.reports;
    const auto done = write_text(options.output, written(format, made));
    if (!done) return done;
    if (made.back().stopped.empty() && measured.captures == captures->size()) return check_answered(made);
    const std::string missing = made.back().stopped.empty() ? "stopped before the next frame" : made.back().stopped;
    if (signal.token().stop_requested()) return fail(Fault::stopped, "session.stopped", "{progress}", missing);
    to_stderr("strata: {} minutes are over: {}\n", *options.minutes, missing);
    return done;
}

}  // namespace

std::function<Result<void>()> declare_report(CLI::App& app) {
    const auto options = std::make_shared<ReportArguments>();
    CLI::Option* captures = app.add_option("captures", options->captures,
                                           "captures (.strata files), or folders of them; several are also pooled into one table")
                                ->type_name(input_files);
    CLI::Option* hard_cases =
        app.add_flag("--hard-cases", options->hard_cases,
                     "run every transparency technique on frames built to break it; print pass or the size of the error")
            ->excludes(captures);
    app.add_flag("--variants", options->variants,
                 "run --hard-cases also at each technique's other settings, not only at the defaults")
        ->needs(hard_cases);
    CLI::Option* needs =
        app.add_flag("--needs", options->needs,
                     "show what frames make and how much of it is read: by stage and by image or buffer, with times")
            ->excludes(hard_cases);
    add_eye(app, options->eye);
    app.get_option("--eye")->needs(needs);
    add_options(app, options->open.device);
    app.add_flag("--allow-partial", options->open.allow_partial, "read the complete frames of a truncated file");
    add_options(app, options->choices);
    app.add_option("--stage", options->stage, "stage whose techniques are measured, default transparency");
    CLI::Option* techniques =
        app.add_option("--techniques", options->techniques,
                       "techniques to measure with their settings, like 'moments kind=power6,weighted'; default: all");
    techniques->delimiter(',')->allow_extra_args(false);
    app.add_flag("--defaults", options->defaults, "measure each technique only at its default settings")->excludes(techniques);
    app.add_option(
        "--error", options->error,
        "answer which technique is fastest with at most this error, like 1%: of white (below .5 % it is not seen, 1 to "
        "2 % is seen when looked for, over 5 % is obvious); relative:3% is of radiance");
    app.add_option("--error-at", options->error_at,
                   "measure errors of the stage's output or of the final picture; default: picture, unless the stage makes "
                   "radiance")
        ->check(one_of({"stage", "picture"}));
    app.add_option("--metric", options->metric,
                   "rank rows by the error of what a display shows of radiance (display, the default), or by that of radiance "
                   "(relative), which a single bright sample can decide")
        ->check(one_of({"display", "relative"}));
    app.add_option("--within", options->within,
                   "answer which technique is most accurate within this multiple of the baseline's time, like 2x, or within this "
                   "time, like 2ms");
    app.add_option("--memory", options->memory,
                   "answer which technique is most accurate in so much memory of its own, like 64MiB")
        ->transform(CLI::AsSizeValue(/*kb_is_1000=*/false));
    app.add_option("--cost", options->cost,
                   "cost of which the answer has least: time (default), memory, or cycles:GPU, the time that shaders take on "
                   "a GPU model that need not be there, like cycles:ps4 (strata isa lists them); --within then limits that");
    app.add_option("--sweep", options->sweeps,
                   "measure each value of a parameter, as key=a,b,c, instead of each technique's own settings; repeatable")
        ->allow_extra_args(false);
    app.add_option("--frames,--frame", options->frames,
                   "indices of frames, like 0,4-8; default 0. Several are also pooled: of a capture the worst frame decides");
    app.add_option("--repeats", options->repeats,
                   "timed repeats of each row; default: 3, 1 where a row is far behind another, 7 where its rank is uncertain")
        ->check(from_to(1, 1000));
    app.add_option("--minutes", options->minutes, "stop after this many minutes and report what is measured by then")
        ->check(from_to(1e-3, 1e6));
    app.add_option("--flicker", options->flicker,
                   "measure how errors change while the camera moves ahead and turns, over this many positions (64 if "
                   "no number follows)")
        ->expected(0, 1)
        ->default_str("64")
        ->type_name("POSITIONS")
        ->transform(CLI::Validator(problem_of_positions, ""));
    app.add_option("--dolly", options->dolly,
                   "meters that the camera moves in all; default: 1/20 of the distance to the center of the transparent geometry")
        ->needs("--flicker");
    app.add_option("--pan", options->pan, "degrees that the camera turns to the right in all, default 5")->needs("--flicker");
    add_formats(app, options->output);
    add_output_file(app, options->output,
                    "write the report to this file instead of stdout, in the format of its ending: .html (a page with plots and "
                    "pictures), .svg (error against cost), .json, .csv, .md or .txt");
    return [options, &app] { return report(*options, app); };
}

}  // namespace strata
