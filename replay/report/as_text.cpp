// Reports for a terminal: what ranks techniques. Everything else that was measured is in JSON and CSV.
#include <algorithm>
#include <map>
#include <set>

#include "passes/stages.h"
#include "replay/plural.h"
#include "replay/report/report_columns.h"
#include "replay/report/variants.h"
#include "replay/report/warnings.h"
#include "replay/session/choice_text.h"
#include "replay/session/light_unit.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

constexpr std::string_view legend = "* nothing is both more accurate and faster, + nothing is both more accurate and smaller\n";
constexpr std::string_view tie_legend = "= faster than a more accurate row, but by less than the spread of their times\n";

/// What the marks of a table stand for.
template <typename Row>
std::string legends(const std::vector<Row>& rows) {
    const bool has_other_truth = std::ranges::any_of(rows, &Row::has_other_truth);
    return std::string(legend) + (has_other_truth ? fmt::format("t {}\n", other_truth_note) : "");
}

bool has_coverage_flicker(const Report& report) {
    return std::ranges::any_of(report.rows, [](const Measurement& row) { return row.coverage_flicker.has_value(); });
}

/// The most accurate row of each budget, with what it is ranked by. Without a time unit time has none.
template <typename Row>
std::string best_rows(const std::vector<Row>& rows, const std::vector<Standing>& standings, const RankingError& error,
                      std::string_view unit) {
    std::string text = fmt::format("\nmost accurate by {}{}\n", error.name,
                                   unit.empty() ? "" : fmt::format(", with a time in units of {}'s", below_stage(unit)));
    for (const Budget& budget : budgets()) {
        if (budget.cost == &Standing::time && unit.empty()) continue;
        const auto best = best_within(standings, budget);
        text += fmt::format("   {:<22} {:<8} {}\n", name(budget), best ? error.text(*standings[*best].error) : "",
                            best ? short_label(rows[*best]) : "nothing");
    }
    return text;
}

template <typename Made>
std::string answer_text(const Made& made) {
    const auto lines = answer_lines(made);
    return lines.empty() ? "" : "\n" + as_text(lines);
}

std::string counters_text(const Measurement& row) {
    std::string text;
    for (const CounterRecord& counter : row.counters)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counter.name, counter.value);
    return text;
}

/// Rows of a technique that counted the same are one line.
std::string counters_text(const Report& report) {
    std::map<std::string, std::map<std::string, std::vector<const Measurement*>>> by_technique;
    for (const Measurement& row : report.rows)
        if (!row.counters.empty()) by_technique[row.technique][counters_text(row)].push_back(&row);
    std::string text;
    for (const auto& [technique, by_counters] : by_technique)
        for (const auto& [counters, rows] : by_counters) {
            const std::string several = fmt::format("{} at {}", below_stage(technique), plural(rows.size(), "setting"));
            text += fmt::format("   {}: {}\n", rows.size() == 1 ? short_label(*rows.front()) : several, counters);
        }
    return text.empty() ? "" : "\ncounted\n" + text;
}

/// The techniques whose models repeat bit patterns of the shader that they judge.
std::string mirrors_text(const Report& report) {
    std::set<std::string> mirrors;
    for (const Measurement& row : report.rows)
        if (row.model_is == ModelKind::mirror) mirrors.insert(below_stage(row.technique));
    std::string names;
    for (const std::string& technique : mirrors) names += (names.empty() ? "" : ", ") + technique;
    return names.empty() ? "" : fmt::format("models that mirror bit patterns of the shader: {}\n", names);
}

/// GPU against model: one sentence, or one for each row that has a bug.
std::string implementation_text(const Report& report) {
    double worst = 0;
    std::string wrong;
    if (std::ranges::any_of(report.rows, is_nothing_compared))
        wrong = "implementations: not every model could be compared; rounding decides every texel\n";
    for (const Measurement& row : report.rows) {
        worst = std::max(worst, row.accuracy.model_rmse);
        if (const std::string doubt = implementation_doubt(row); !doubt.empty())
            wrong += fmt::format("! {} {}\n", short_label(row), doubt);
    }
    return wrong.empty() ? fmt::format("implementations: all within tolerance of their models, rmse {:.1e} at most\n", worst)
                         : wrong;
}

/// A truth other than the stage's with the rows that are measured against it.
std::string truth_text(const Report& report, const ReportTruth& truth) {
    if (truth.name.empty()) return fmt::format("truth: {}\n", truth.is);
    std::string rows;
    for (const Measurement& row : report.rows)
        if (row.truth == truth.name) rows += (rows.empty() ? "" : ", ") + short_label(row);
    return fmt::format("truth of {}: {}\n", rows, truth.is);
}

/// Lines on the samples that rounding decides, and on those left out of the errors.
std::string undecided_text(const Accuracy& accuracy, std::string_view samples) {
    std::string text;
    if (const auto& bound = accuracy.undecided_bound)
        text += fmt::format(
            "rounding decides {:.3g} % of {}: their error is the distance to what it allows, which hides at most {}"
            "{} of {}\n",
            100 * accuracy.undecided_share, samples, short_number(bound->value), bound->unit.empty() ? "" : " " + bound->unit,
            bound->name);
    if (accuracy.unjudged_share > 0)
        text += fmt::format("left out of the errors: {:.3g} % of {}, where rounding decides what is drawn or in which order\n",
                            100 * accuracy.unjudged_share, samples);
    return text;
}

std::string heading(const Report& report) {
    std::string text =
        fmt::format("{} of {} frame {}, {} x {}, {} per pixel, capture {}\n", name(report.stage), report.capture_name,
                    report.frame, report.width, report.height, plural(report.samples, "sample"), report.capture_id);
    const std::string count = report.least_repeats < report.repeats && report.least_repeats > 0
                                  ? fmt::format("{} to {}", report.least_repeats, plural(report.repeats, "timed run"))
                                  : plural(report.repeats, "timed run");
    const std::string repeats = report.is_timed ? fmt::format(", {} each, interleaved", count) : "";
    text += fmt::format("device {} ({}){}\n", report.device.name, report.device.driver, repeats);
    if (report.device.software) text += "a CPU renders here: times rank techniques on this driver only, they model no GPU\n";
    if (!report.skipped.empty()) return text + fmt::format("the frame does not need this stage: {}\n", report.skipped);
    for (const ReportTruth& truth : report.truths) text += truth_text(report, truth);
    const bool of_picture = report.error_at == ErrorAt::picture;
    if (of_picture) text += "errors are of the picture: the later stages run from each row's outputs and from the truth\n";
    if (const std::string why = no_picture_text(report); !why.empty()) text += why + "\n";
    const Measurement* measured = first_measured(report);
    if (measured) text += undecided_text(measured->accuracy, of_picture ? "pixels" : "samples");
    if (measured && measured->accuracy.not_numbers > 0)
        text += fmt::format("left out of the errors: {}, NaN in the truth and in the result of {}\n",
                            plural(measured->accuracy.not_numbers, of_picture ? "pixel" : "sample"), measured->technique);
    if (leaves_much(report))
        text += fmt::format("touched: errors over the {:.3g} % of {} that the stage {}\n", 100 * measured->accuracy.touched_share,
                            of_picture ? "pixels" : "samples",
                            holds_radiance(info(report.stage).outputs.front()) ? "changes" : "can change");
    if (report.flicker)
        text += fmt::format("flicker: mean change of the error from frame to frame, {}: {} m ahead, {} degrees to the right\n",
                            plural(report.flicker->frames, "frame"), short_number(*report.flicker->dolly),
                            short_number(report.flicker->pan));
    if (has_coverage_flicker(report))
        text += "coverage flicker: the same of the share that masked surfaces cover of each pixel, over pixels that have any\n";
    return text;
}

std::string warnings_text(const Report& report) {
    std::string text;
    for (const Warning& warning : warnings_of(report)) text += fmt::format("! {}\n", warning.text);
    return text;
}

/// Rows of which the same is said are one line.
std::string light_text(const Report& report) {
    std::map<std::string, std::vector<const Measurement*>> by_faults;
    for (const Measurement& row : report.rows)
        if (std::string faults = light_faults(row); !faults.empty()) by_faults[std::move(faults)].push_back(&row);
    std::string text;
    for (const auto& [faults, rows] : by_faults)
        text += fmt::format("   {}: {}\n", rows.size() == 1 ? short_label(*rows.front()) : plural(rows.size(), "row"), faults);
    return text.empty() ? "" : "\nlight that images could not hold\n" + text;
}

}  // namespace

std::string times_text(const Report& report) {
    const Question& asked = report.question;
    if (!asked.gpu.empty()) return fmt::format("times are modeled for {}: instructions alone, no memory, no blending", asked.gpu);
    if (asked.cost != &Standing::time && !asked.within && !asked.within_ms) return {};
    if (!report.device.software) return fmt::format("times are of {}", report.device.name);
    return fmt::format("times are of {}, a CPU, and no GPU's: --cost cycles:GPU models one", report.device.driver);
}

std::string no_picture_text(const Report& report) {
    return report.no_picture.empty() ? "" : "errors are of the stage, not of the picture: " + report.no_picture;
}

std::string without_modeled_time(const Report& report) {
    if (report.question.gpu.empty()) return {};
    std::vector<std::string> rows;
    std::string why;
    for (const Measurement& row : report.rows) {
        if (!row.is_measured() || !row.modeled || row.modeled->ms) continue;
        rows.push_back(short_label(row));
        if (why.empty()) why = row.modeled->missing;
    }
    return rows.empty() ? "" : fmt::format("{}, which therefore take no part ({})", first_of(rows), why);
}

std::vector<AnswerLine> answer_lines(const Report& report) {
    if (!report.question.is_asked()) return {};
    if (changes_too_little(report))
        return {{"answer", fmt::format("none; the stage changes fewer than {} pixels of this view", fewest_pixels)}};
    const std::vector<Standing> rows = asked_standings(report);
    const auto baseline = baseline_of(report);
    const bool has_unit = has_time_unit(report.question, rows, baseline);
    AnswerNames names{.rows = {},
                      .error = ranking_error(report),
                      .unit = has_unit ? below_stage(report.time_unit) : "",
                      .times_are = times_text(report),
                      .without_time = without_modeled_time(report)};
    for (const Measurement& row : report.rows) {
        names.rows.push_back(short_label(row));
        names.commands.push_back(command_of(report, row));
    }
    if (baseline && report.rows[*baseline].sort_ms && report.question.gpu.empty())
        names.baseline_note = fmt::format("its time contains {} ms in which the CPU sorts {} and {}",
                                          short_number(report.rows[*baseline].sort_ms->median),
                                          plural(report.sorted_objects, "object"), plural(report.sorted_particles, "particle"));
    return answer_lines(rows, baseline, report.question, names);
}

std::string command_of(const Report& report, const Measurement& row) {
    const Request request = request_of(row, report.base);
    return replay_command(report.capture_name, request.variant, request.choices);
}

std::string light_faults(const Measurement& row) {
    std::string text;
    for (const LightFault& fault : row.accuracy.light_faults) text += (text.empty() ? "" : "; ") + sentence(fault);
    return text;
}

std::string implementation_doubt(const Measurement& row) {
    const Accuracy& accuracy = row.accuracy;
    if (!accuracy.incomparable.empty()) return fmt::format("cannot be compared: {}", accuracy.incomparable);
    const bool on_average = accuracy.model_rmse > row.tolerance;
    if (!on_average && accuracy.model_worst <= row.tolerated_worst) return {};
    return fmt::format("is {:.1e} from its own model{}, {:.1e} is tolerated: a bug, or this driver's rounding",
                       on_average ? accuracy.model_rmse : accuracy.model_worst, on_average ? "" : " in one texel",
                       on_average ? row.tolerance : row.tolerated_worst);
}

bool is_nothing_compared(const Measurement& row) { return row.accuracy.compared == 0 && row.accuracy.undecided > 0; }

Page page_of(const Report& report) {
    Page page{heading(report)};
    if (!report.skipped.empty()) return page;
    const std::string stopped = report.stopped.empty() ? "" : "\n" + report.stopped + "\n";
    page.insert(page.end(), {warnings_text(report) + "\n", sheet_of(report), "\n"});
    if (!report.is_timed) {
        page.emplace_back(implementation_text(report) + stopped);
        return page;
    }
    const bool has_ties = std::ranges::any_of(report.rows, &Measurement::is_tied);
    page.emplace_back(legends(report.rows) + std::string(has_ties ? tie_legend : "") + implementation_text(report) +
                      light_text(report) + mirrors_text(report) +
                      best_rows(report.rows, standings(report.rows), ranking_error(report), report.time_unit) +
                      counters_text(report) + stopped + answer_text(report));
    return page;
}

Page page_of(const Pool& pool) {
    const std::string mean = pool.captures < 2 ? "" : pool.error.is_of_white ? "mean of " : "geometric mean of ";
    const char* of_frames = pool.frames > pool.captures ? "the error of the worst frame" : "errors";
    std::string head = fmt::format("{} of {}: {}{}{}, geometric mean of times\n", name(pool.stage), frames_text(pool), mean,
                                   of_frames, mean.empty() || pool.frames == pool.captures ? "" : " of each");
    if (!pool.left_out.empty())
        head += fmt::format("left out, because errors are of the stage alone or the stage changes fewer than {} pixels: {}\n",
                            fewest_pixels, first_of(pool.left_out));
    return {head + "\n", sheet_of(pool),
            "\n" + legends(pool.rows) + best_rows(pool.rows, standings(pool), pool.error, pool.time_unit) + answer_text(pool)};
}

Page page_of(std::span<const Report> reports, const Pool& pool) {
    Page page;
    for (const Report& report : reports) {
        std::ranges::move(page_of(report), std::back_inserter(page));
        page.emplace_back("\n");
    }
    std::ranges::move(page_of(pool), std::back_inserter(page));
    return page;
}

std::string as_text(const Report& report) { return as_text(page_of(report)); }
std::string as_text(const Pool& pool) { return as_text(page_of(pool)); }

}  // namespace strata
