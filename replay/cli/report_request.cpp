#include "replay/cli/report_request.h"

#include <algorithm>

#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/cli/limits.h"
#include "replay/isa/gpu_models.h"
#include "replay/report/variants.h"
#include "replay/session/choice_text.h"

namespace strata {
namespace {

Result<Sweep> parse_sweep(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals + 1 == text.size())
        return fail(Fault::usage, "options.malformed", "{option} takes key=a,b,c, not '{value}'", "--sweep", text);
    Sweep sweep{.key = text.substr(0, equals)};
    for (std::size_t begin = equals + 1; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        sweep.values.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return sweep;
}

/// --cost and the limits of what rows cost.
Result<void> read_costs(const ReportArguments& options, Question& question) {
    constexpr std::string_view of_gpu = "cycles:";
    if (options.cost.starts_with(of_gpu)) {
        const auto model = find_compiled_gpu_model(std::string_view(options.cost).substr(of_gpu.size()));
        if (!model) return model.error();
        question.gpu = (*model)->name;
    } else if (options.cost == "memory") {
        question.cost = &Standing::bytes_per_pixel;
    } else if (options.cost != "time") {
        return fail(Fault::usage, "options.malformed", "{option} takes {form}, not '{value}'", "--cost",
                    "time, memory or cycles:GPU", options.cost);
    }
    const bool is_of_time = options.within.ends_with("ms");
    const auto within = parse_limit("--within", options.within, is_of_time ? "ms" : "x", 1);
    if (!within) return within.error();
    (is_of_time ? question.within_ms : question.within) = *within;
    if (options.memory) question.memory = double(*options.memory);
    if (options.cost == "memory" && !question.is_asked())
        return fail(Fault::usage, "report.cost_without_limits",
                    "--cost memory says what an answer has least of; ask for one with --error, --within or --memory");
    return {};
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
    return fail(Fault::usage, "report.setting_of_some_rows",
                "--set {setting} does not apply to every row of the report: {technique} has no '{parameter}'; pass it to one row "
                "with --techniques '{variant}'",
                text, lacking->technique->name, change.key,
                fmt::format("{} {}", short_name(*own), text.substr(text.find(':') + 1)));
}

/// --use and --set are for the other stages: the rows are the techniques of the measured one.
Result<void> check_choices(const ReportRequest& wanted, std::span<const Variant> rows) {
    const ChoiceChanges& choices = wanted.base.choices;
    if (const Technique* used = choices.techniques[static_cast<std::size_t>(wanted.stage)])
        return fail(Fault::usage, "report.use_of_measured_stage",
                    "--use {technique} does not apply: a report of {stage} measures its techniques; choose them with "
                    "--techniques {variant}",
                    used->name, name(wanted.stage), short_name(*used));
    for (const SettingChange& change : choices.settings)
        if (const auto fits = check_setting(change, wanted, rows); !fits) return fits;
    return {};
}

}  // namespace

Result<ReportRequest> request_of(const ReportArguments& options) {
    auto base = request_of(options.choices);
    if (!base) return base.error();
    ReportRequest wanted{.base = *base};
    if (options.repeats) wanted.repeats = *options.repeats;
    else wanted.least_repeats = 3;
    if (!options.error_at.empty()) wanted.error_at = options.error_at == "picture" ? ErrorAt::picture : ErrorAt::stage;
    if (options.metric == "relative") wanted.ranked_by = RankedBy::relative_rmse;
    const auto stage = stage_called(options.stage);
    if (!stage) return stage.error();
    wanted.stage = *stage;
    for (const std::string& text : options.sweeps) {
        const auto sweep = parse_sweep(text);
        if (!sweep) return sweep.error();
        wanted.sweeps.push_back(*sweep);
    }
    wanted.techniques = options.techniques;
    wanted.defaults_only = options.defaults;
    constexpr std::string_view of_radiance = "relative:";
    std::string limit = options.error;
    if (limit.starts_with(of_radiance)) {
        limit.erase(0, of_radiance.size());
        wanted.ranked_by = RankedBy::relative_rmse;
        if (limit.empty())
            return fail(Fault::usage, "options.malformed", "{option} takes relative:3%, not '{value}'", "--error", options.error);
    }
    const auto error = parse_limit("--error", limit, "%", .01);
    if (!error) return error.error();
    wanted.question = {.error = *error};
    if (const auto read = read_costs(options, wanted.question); !read) return read.error();
    const auto rows = variants(wanted);
    if (!rows) return rows.error();  // before a capture is opened
    if (const auto fits = check_choices(wanted, *rows); !fits) return fits.error();
    if (options.flicker) wanted.flicker = Walk{.frames = *options.flicker, .dolly = options.dolly};
    if (options.pan) wanted.flicker->pan = *options.pan;
    return wanted;
}

}  // namespace strata
