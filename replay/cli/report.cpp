// strata report: error against time for every technique of a stage.
#include <unistd.h>

#include <memory>

#include <CLI/CLI.hpp>

#include "capture_format/nearest_name.h"
#include "capture_format/whole_file.h"
#include "replay/cli/verb_options.h"
#include "replay/report/report.h"

namespace strata {
namespace {

struct Options {
    OpenOptions open;
    ChoiceOptions choices;
    std::string stage = "transparency";
    std::vector<std::string> sweeps;
    std::size_t frame = 0, repeats = 7;
    bool json = false, csv = false;
    std::filesystem::path output;
};

Result<Sweep> parse_sweep(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == text.npos || equals + 1 == text.size()) return fail(Fault::usage, "--sweep takes key=a,b,c, not '{}'", text);
    Sweep sweep{.key = text.substr(0, equals)};
    for (std::size_t begin = equals + 1; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        sweep.values.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return sweep;
}

/// One line that rewrites itself, on a terminal only.
void show_progress(std::string_view what, double done) {
    if (!isatty(STDERR_FILENO)) return;
    constexpr int cells = 30;
    const int full = static_cast<int>(done * cells);
    fmt::print(stderr, "\r\033[K[{:#<{}}{:.<{}}] {}", "", full, "", cells - full, what);
    if (done >= 1) fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
}

Result<void> write_report(const Options& options, const Report& made) {
    const std::string text = options.json ? as_json(made) : options.csv ? as_csv(made) : as_text(made);
    if (options.output.empty()) {
        fmt::print("{}", text);
        return {};
    }
    return write_whole_file(options.output, text);
}

Result<void> report(const Options& options) {
    auto base = request_of(options.choices);
    if (!base) return base.error();
    base->frame = options.frame;
    ReportRequest wanted{.base = *base, .repeats = options.repeats};
    const auto stage = find_stage(options.stage);
    std::vector<std::string_view> known;
    for (const StageInfo& info : stages()) known.push_back(info.name);
    if (!stage) return fail(Fault::usage, "there is no stage '{}'{}", options.stage, did_you_mean(options.stage, known));
    wanted.stage = *stage;
    for (const std::string& text : options.sweeps) {
        const auto sweep = parse_sweep(text);
        if (!sweep) return sweep.error();
        wanted.sweeps.push_back(*sweep);
    }
    auto session = open(options.open);
    if (!session) return session.error();
    const auto made = make_report(**session, wanted, show_progress);
    if (!made) return made.error();
    return write_report(options, *made);
}

}  // namespace

std::function<Result<void>()> declare_report(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    add_options(app, options->open);
    add_options(app, options->choices);
    app.add_option("--stage", options->stage, "whose techniques, default transparency");
    app.add_option("--sweep", options->sweeps, "key=a,b,c: measure each value; may be repeated")->allow_extra_args(false);
    app.add_option("--frame", options->frame, "which frame, default 0");
    app.add_option("--repeats", options->repeats, "timed runs of each row after a warm-up, default 7")
        ->check(CLI::Range(1, 1000));
    app.add_flag("--json", options->json, "one JSON object");
    app.add_flag("--csv", options->csv, "comma-separated values");
    app.add_option("-o,--output", options->output, "write to a file instead of stdout");
    return [options] { return report(*options); };
}

}  // namespace strata
