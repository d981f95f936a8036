// strata report: error against time for every technique of a stage.
#include <charconv>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include <CLI/CLI.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/nearest_name.h"
#include "passes/registry.h"
#include "replay/cli/given_options.h"
#include "replay/cli/left_out.h"
#include "replay/cli/verb_options.h"
#include "replay/progress_line.h"
#include "replay/report/hard_cases.h"
#include "replay/report/pooled.h"
#include "replay/report/table.h"
#include "replay/report/variants.h"
#include "replay/session/choice_text.h"

namespace strata {
namespace {

struct ReportArguments {
    std::vector<std::filesystem::path> captures;
    OpenOptions open;
    ChoiceOptions choices;
    std::string stage = "transparency";
    std::vector<std::string> sweeps, methods;
    std::string error, within, error_at = "stage";
    bool defaults = false;
    std::size_t frame = 0;
    std::optional<std::size_t> repeats;
    std::optional<double> minutes;
    std::optional<std::uint32_t> flicker;
    std::optional<double> dolly, pan;
    bool json = false, csv = false, hard_cases = false, points = false;
    std::filesystem::path output;
};

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

Result<Sweep> parse_sweep(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos || equals + 1 == text.size())
        return fail_unnamed(Fault::usage, "--sweep takes key=a,b,c, not '{}'", text);
    Sweep sweep{.key = text.substr(0, equals)};
    for (std::size_t begin = equals + 1; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        sweep.values.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return sweep;
}

/// A number above 0 with an optional unit at its end: "1%" is .01, "2x" is 2.
Result<std::optional<double>> parse_limit(const char* option, std::string text, char unit, double factor) {
    if (text.empty()) return std::optional<double>();
    const std::string given = text;
    const bool has_unit = text.back() == unit;
    if (has_unit) text.pop_back();
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size() || !(value > 0) || !std::isfinite(value))
        return fail_unnamed(Fault::usage, "{} takes a number above 0, like 2{}, not '{}'", option, unit, given);
    return std::optional(has_unit ? value * factor : value);
}

std::string written(const ReportArguments& options, std::span<const Report> made) {
    if (made.size() == 1) return options.json ? as_json(made[0]) : options.csv ? as_csv(made[0]) : as_text(made[0]);
    const Pool pool = pooled(made);
    if (options.json || options.csv) return options.json ? as_json(made, pool) : as_csv(made, pool);
    std::string text;
    for (const Report& one : made) text += as_text(one) + "\n";
    return text + as_text(pool);
}

/// A setting of the measured stage alone that not every row has: which rows are to have it?
Result<void> check_setting(const SettingChange& change, const ReportRequest& wanted, std::span<const Variant> rows) {
    const Technique* own = nullptr;
    for (const Technique& technique : techniques()) {
        if (!change.fits(technique)) continue;
        if (technique.stage != wanted.stage) return {};
        if (!own) own = &technique;
    }
    const auto lacking = std::ranges::find_if(rows, [&](const Variant& row) { return !change.fits(*row.technique); });
    if (!own || lacking == rows.end()) return {};
    ChoiceChanges alone;
    alone.settings.push_back(change);
    const std::string text = set_texts(alone).front();
    return fail_unnamed(
        Fault::usage,
        "--set {} cannot be given to every row of the report: {} has no '{}'; give it to one row with --methods '{} {}'", text,
        lacking->technique->name, change.key, short_name(*own), text.substr(text.find(':') + 1));
}

/// --use and --set are for the other stages: the rows are the techniques of the measured one.
Result<void> check_choices(const ReportRequest& wanted, std::span<const Variant> rows) {
    const ChoiceChanges& choices = wanted.base.choices;
    if (const Technique* used = choices.techniques[static_cast<std::size_t>(wanted.stage)])
        return fail_unnamed(Fault::usage,
                            "--use {} does not apply: a report of {} measures its techniques; choose them with --methods {}",
                            used->name, name(wanted.stage), short_name(*used));
    for (const SettingChange& change : choices.settings)
        if (const auto fits = check_setting(change, wanted, rows); !fits) return fits;
    return {};
}

Result<ReportRequest> request_of(const ReportArguments& options) {
    auto base = request_of(options.choices);
    if (!base) return base.error();
    base->variant.frame = options.frame;
    ReportRequest wanted{.base = *base};
    if (options.repeats) wanted.repeats = *options.repeats;
    else wanted.least_repeats = 3;
    if (options.error_at == "picture") wanted.error_at = ErrorAt::picture;
    const auto stage = find_stage(options.stage);
    std::vector<std::string_view> known;
    for (const StageInfo& info : stages()) known.push_back(info.name);
    if (!stage) return fail_unnamed(Fault::usage, "there is no stage '{}'{}", options.stage, did_you_mean(options.stage, known));
    wanted.stage = *stage;
    for (const std::string& text : options.sweeps) {
        const auto sweep = parse_sweep(text);
        if (!sweep) return sweep.error();
        wanted.sweeps.push_back(*sweep);
    }
    wanted.methods = options.methods;
    wanted.defaults_only = options.defaults;
    const auto error = parse_limit("--error", options.error, '%', .01), within = parse_limit("--within", options.within, 'x', 1);
    if (!error) return error.error();
    if (!within) return within.error();
    wanted.question = {.error = *error, .within = *within};
    const auto rows = variants(wanted);
    if (!rows) return rows.error();  // before a capture is opened
    if (const auto fits = check_choices(wanted, *rows); !fits) return fits.error();
    if (options.flicker) wanted.flicker = Walk{.frames = *options.flicker, .dolly = options.dolly};
    if (options.pan) wanted.flicker->pan = *options.pan;
    return wanted;
}

/// "64". A capture behind --flicker would be taken for its number.
std::string problem_of_positions(std::string& text) {
    std::uint32_t count = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (problem == std::errc() && end == text.data() + text.size() && count >= 2 && count <= 10000) return {};
    return fmt::format("takes a number of positions from 2 to 10000, not '{}'; captures stand before it", text);
}

Result<void> write(const ReportArguments& options, const std::string& text) {
    if (!options.output.empty()) return write_whole_file(options.output, text);
    to_stdout("{}", text);
    return {};
}

Result<void> report_hard_cases(const ReportArguments& options) {
    auto rows = variants({.stage = Stage::transparency});
    if (!rows) return rows.error();
    if (!options.points) std::erase_if(*rows, [](const Variant& row) { return !row.settings.empty(); });
    const StopAtSignal signal;
    return measure_hard_cases(options.open.device, *rows, progress_line(), signal.token()).and_then([&](auto& made) {
        const auto done = write(options, options.json ? as_json(made) : as_text(made));
        return done && !made.stopped.empty() ? Result<void>(fail_unnamed(Fault::stopped, "{}", made.stopped)) : done;
    });
}

Result<void> report(const ReportArguments& options, const CLI::App& app) {
    if (options.hard_cases) {
        const auto fits = check_not_given(
            app,
            {"--csv", "--allow-partial", "--use", "--set", "--force", "--samples", "--stage", "--methods", "--defaults",
             "--error", "--error-at", "--within", "--sweep", "--frame", "--repeats", "--minutes", "--flicker"},
            "--hard-cases brings frames and settings of its own and writes text or --json");
        return fits ? report_hard_cases(options) : fits;
    }
    if (options.captures.empty())
        return fail_unnamed(Fault::usage, "strata report wants a capture, or --hard-cases, which brings its own frames");
    const auto wanted = request_of(options);
    if (!wanted) return wanted.error();
    ReportRequest request = *wanted;
    request.on_row = [](const Measurement& row, std::size_t place, std::size_t of) {
        const std::string row_label = label(row.technique, row.settings);
        if (!row.accuracy.not_supported.empty()) return to_stderr("strata: {} of {}  {}: not supported\n", place, of, row_label);
        const std::string time = row.time ? fmt::format("time {}", short_number(row.time->median))
                                          : fmt::format("{} ms", short_number(row.stage_ms.median));
        to_stderr("strata: {} of {}  {}: {} {}, {}\n", place, of, row_label, ranking_name(row),
                  short_number(ranking_figure(row).value), time);
    };
    const Progress progress = progress_line();
    const StopAtSignal signal;
    const Deadline deadline(options.minutes, signal.token());
    std::vector<Report> made;
    LeftOutNotes notes;
    for (const std::filesystem::path& capture : options.captures) {
        OpenOptions one = options.open;
        one.capture = capture;
        auto session = open(one);
        if (!session) return session.error();
        if (const auto told = notes.tell(**session, request.base); !told) return told;
        (*session)->stop_when(deadline.token());
        auto report = make_report(**session, request, progress);
        if (!report && report.error().fault == Fault::stopped && !made.empty()) break;
        if (!report && report.error().fault == Fault::stopped && !signal.token().stop_requested())
            return fail_unnamed(Fault::usage, "no row was measured within {} minutes; give the report more time",
                                *options.minutes);
        if (!report) return report.error();
        report->capture_name = capture.filename().string();
        made.push_back(*std::move(report));
        if (deadline.token().stop_requested()) break;
    }
    const auto done = write(options, written(options, made));
    if (!done || (made.back().stopped.empty() && made.size() == options.captures.size())) return done;
    const std::string missing = made.back().stopped.empty() ? "stopped before the next capture" : made.back().stopped;
    if (signal.token().stop_requested()) return fail_unnamed(Fault::stopped, "{}", missing);
    to_stderr("strata: {} minutes are over: {}\n", *options.minutes, missing);
    return done;
}

}  // namespace

std::function<Result<void>()> declare_report(CLI::App& app) {
    const auto options = std::make_shared<ReportArguments>();
    CLI::Option* captures =
        app.add_option("captures", options->captures, "captures (.strata files); several are also pooled into one table")
            ->type_name(input_file);
    CLI::Option* hard_cases =
        app.add_flag("--hard-cases", options->hard_cases,
                     "run every transparency technique on frames built to break it; print pass or the size of the error")
            ->excludes(captures);
    app.add_flag("--points", options->points,
                 "run --hard-cases also at each technique's other settings, not only at the defaults")
        ->needs(hard_cases);
    add_options(app, options->open.device);
    app.add_flag("--allow-partial", options->open.allow_partial, "read the complete frames of a truncated file");
    add_options(app, options->choices);
    app.add_option("--stage", options->stage, "stage whose techniques are measured, default transparency");
    CLI::Option* methods =
        app.add_option("--methods", options->methods,
                       "techniques to measure with their settings, like 'moments kind=power6,weighted'; default: all");
    methods->delimiter(',')->allow_extra_args(false);
    app.add_flag("--defaults", options->defaults, "measure each technique only at its default settings")->excludes(methods);
    app.add_option("--error", options->error,
                   "answer which technique, the baseline aside, is cheapest with at most this error, like 1%");
    app.add_option("--error-at", options->error_at,
                   "measure errors of the stage's output, or of the picture that the later stages make of it")
        ->check(one_of({"stage", "picture"}));
    app.add_option("--within", options->within,
                   "answer which technique, the baseline aside, is most accurate within this multiple of its time, like 2x");
    app.add_option("--sweep", options->sweeps,
                   "measure each value of a parameter, as key=a,b,c, instead of each technique's own settings; repeatable")
        ->allow_extra_args(false);
    app.add_option("--frame", options->frame, "index of the frame, default 0");
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
    CLI::Option* json = app.add_flag("--json", options->json, "print JSON instead of text");
    app.add_flag("--csv", options->csv, "print comma-separated values instead of text")->excludes(json);
    app.add_option("-o,--output", options->output, "write the report to this file instead of stdout")->type_name(output_file);
    return [options, &app] { return report(*options, app); };
}

}  // namespace strata
