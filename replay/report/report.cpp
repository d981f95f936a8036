#include "replay/report/report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "capture_format/view.h"
#include "passes/registry.h"
#include "passes/scene/object_order.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/report/flicker.h"
#include "replay/report/modeled_cost.h"
#include "replay/report/pictures.h"
#include "replay/report/row_maker.h"
#include "replay/report/variants.h"
#include "replay/report/warnings.h"
#include "replay/session/choice_text.h"

namespace strata {
namespace {

/// Flicker of all rows that can do the frame.
Result<void> add_flicker(Session& session, ReportRequest wanted, std::span<const Variant> all, Report& report,
                         const Progress& tell) {
    if (!wanted.flicker->dolly) {
        const auto frame = session.frame(wanted.base.variant.frame);
        if (!frame) return frame.error();
        wanted.flicker->dolly = default_dolly(*frame);
        if (!wanted.flicker->dolly)
            return fail(Fault::usage, "report.no_dolly", "no surface lies before the eye to move towards; give --dolly meters");
    }
    report.flicker = wanted.flicker;
    std::vector<Request> moved;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (report.rows[i].accuracy.not_supported.empty()) moved.push_back(all[i].request);
    const auto flickers = measure_flicker(session, wanted, moved, tell);
    if (!flickers) return flickers.error();
    auto flicker = flickers->begin();
    for (Measurement& row : report.rows)
        if (row.accuracy.not_supported.empty()) {
            row.flicker = flicker->error;
            row.coverage_flicker = flicker->coverage;
            ++flicker;
        }
    return {};
}

/// Draws and particles that a renderer sorts by object.
void count_sorted(const Frame& frame, Report& report) {
    report.sorted_objects = back_to_front_draws(frame).size();
    for (const Emitter& emitter : frame.emitters) report.sorted_particles += emitter.particles.size();
}

/// While a report is made, stage outputs that no other row shares do not fill the memo: it keeps about two frames of them (a
/// frame at 1080p and four samples takes 1 GiB, 130 bytes per sample).
class MemoLimit {
public:
    MemoLimit(Session& session, const View& view) : session_(&session) {
        constexpr std::uint64_t bytes_per_sample = 256, least = std::uint64_t(64) << 20;
        session.limit_memo(std::max(least, bytes_per_sample * view.width * view.height * view.samples));
    }
    ~MemoLimit() { session_->limit_memo(std::numeric_limits<std::uint64_t>::max()); }
    MemoLimit(const MemoLimit&) = delete;
    MemoLimit& operator=(const MemoLimit&) = delete;

private:
    Session* session_;
};

std::vector<ReportTruth> truths_of(const RowTruths& row_truths) {
    std::vector<ReportTruth> truths;
    for (const RowTruth& each : row_truths.all)
        truths.push_back({.name = std::string(each.of.name), .is = each.name, .own_error = each.own_error});
    return truths;
}

/// Progress of a report whose steps take, in units of one run, about 4 for a row's errors, one per timed run, and a run per frame
/// of its flicker; at the end the rows that are timed again, of which there are few.
struct Shares {
    double rows = 4, flicker = 0, again = 0;
    explicit Shares(const ReportRequest& wanted) : flicker(wanted.flicker ? wanted.flicker->frames : 0) {
        const auto least = double(least_repeats_of(wanted));
        rows += least;
        again = .2 * (double(wanted.repeats) - least);
        const double all = rows + flicker + again;
        rows /= all, flicker /= all, again /= all;
    }
};

/// On the GPU that the question names.
Result<void> add_modeled_costs(Session& session, const ReportRequest& wanted, Report& report, const Progress& progress) {
    const auto model = find_compiled_gpu_model(wanted.question.gpu);
    if (!model) return model.error();
    for (std::size_t i = 0; i < report.rows.size(); ++i) {
        if (progress) progress(fmt::format("cycles of {}", (*model)->name), double(i) / double(report.rows.size()));
        auto cost = model_cost(session, wanted.base, report.rows[i], **model, "/proc/self/exe");
        if (!cost) return cost.error();
        report.rows[i].modeled = *std::move(cost);
    }
    return {};
}

/// Whose time may be the unit first, at its defaults before its other settings: each group has it beside its rows.
void put_unit_first(std::vector<Variant>& rows) {
    std::ranges::stable_sort(
        rows, {}, [](const Variant& row) { return row.technique->abilities.is_time_unit ? (row.settings.empty() ? 0 : 1) : 2; });
}

}  // namespace

const Metric& ranking_metric(const Measurement& row) {
    const std::vector<Metric>& metrics = row.accuracy.touched.empty() ? row.accuracy.technique_errors : row.accuracy.touched;
    auto found = metrics.end();
    if (row.ranked_by == RankedBy::display_rmse) found = std::ranges::find(metrics, display_rmse, &Metric::name);
    if (found == metrics.end()) found = std::ranges::find(metrics, "relative rmse", &Metric::name);
    return found == metrics.end() ? metrics.front() : *found;
}

RankingError ranking_error(const Measurement& row) {
    const bool is_touched = !row.accuracy.touched.empty() && row.accuracy.touched_share < 1;
    const Metric& metric = ranking_metric(row);
    return {metric.name + (is_touched ? " touched" : ""), is_of_white(metric)};
}

std::vector<Standing> standings(std::span<const Measurement> rows) {
    std::vector<Standing> all;
    for (const Measurement& row : rows) {
        Standing standing{.time = row.time ? row.time->median : row.stage_ms.median,
                          .spread = row.time ? row.time->mad : row.stage_ms.mad,
                          .bytes_per_pixel = std::round(row.bytes_per_pixel),
                          .ms = row.stage_ms.median,
                          .ms_spread = row.stage_ms.mad,
                          .bytes = double(row.stage_bytes)};
        if (row.is_measured() && !row.has_other_truth)
            standing.error = ranking_metric(row).value, standing.rounding = ranking_error(row).rounding();
        all.push_back(standing);
    }
    return all;
}

std::vector<Standing> asked_standings(const Report& report) {
    std::vector<Standing> all = standings(report.rows);
    if (report.question.gpu.empty()) return all;
    const auto baseline = baseline_of(report);
    const auto ms = [&](std::size_t row) {
        return report.rows[row].modeled ? report.rows[row].modeled->ms : std::optional<double>();
    };
    const double unit = baseline ? ms(*baseline).value_or(0) : 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto modeled = ms(i);
        if (!modeled) all[i].error.reset();
        all[i].ms = modeled.value_or(HUGE_VAL), all[i].ms_spread = 0;
        all[i].time = unit > 0 ? all[i].ms / unit : all[i].ms, all[i].spread = 0;
    }
    return all;
}

std::optional<std::size_t> baseline_of(const Report& report) {
    const auto found = std::ranges::find_if(report.rows, [&](const Measurement& row) {
        return row.technique == report.time_unit && row.settings.empty() && row.accuracy.not_supported.empty();
    });
    return found == report.rows.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - report.rows.begin()));
}

Request request_of(const Measurement& row, Request base) {
    const Technique& technique = **find_technique(row.technique);
    base.choices.use(technique);
    std::istringstream words(row.settings);
    for (std::string word; words >> word;) base.choices.settings.push_back(*parse_setting(technique, word));
    return base;
}

bool is_unanswered(const Report& report) {
    if (!report.question.is_asked() || !report.skipped.empty() || !report.stopped.empty()) return false;
    return !answer_of(report).recommended;
}

Answer answer_of(const Report& report) {
    return changes_too_little(report) ? Answer() : find_answer(asked_standings(report), baseline_of(report), report.question);
}

void mark_fronts(std::vector<Measurement>& rows) {
    const std::vector<Standing> all = standings(rows);
    const std::vector<bool> fast = pareto_front(all, &Standing::time), small = pareto_front(all, &Standing::bytes_per_pixel);
    const std::vector<bool> tied = ties_in_time(all);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].on_front = fast[i];
        rows[i].is_tied = tied[i];
        rows[i].on_memory_front = small[i];
    }
}

std::vector<Metric> errors_of(const Measurement& row) {
    std::vector<Metric> errors = row.accuracy.technique_errors;
    if (row.accuracy.flip) errors.push_back({"FLIP", "", *row.accuracy.flip});
    return errors;
}

Result<Report> make_report(Session& session, const ReportRequest& wanted, const Progress& progress) {
    const auto tell = [&](std::string_view what, double done) {
        if (progress) progress(what, done);
    };
    if (const auto has_some = check_has_techniques(wanted.stage); !has_some) return has_some.error();
    auto all = variants(wanted);
    if (!all) return all.error();
    put_unit_first(*all);
    const auto frame = session.frame(wanted.base.variant.frame);
    if (!frame) return frame.error();
    View view = frame->view;
    if (wanted.base.variant.samples) view.samples = wanted.base.variant.samples;

    Report report{.stage = wanted.stage,
                  .capture_id = session.capture_id(),
                  .base = wanted.base,
                  .frame = wanted.base.variant.frame,
                  .repeats = wanted.repeats,
                  .least_repeats = wanted.least_repeats,
                  .width = view.width,
                  .height = view.height,
                  .samples = view.samples,
                  .device = session.device(),
                  .question = wanted.question};
    const MemoLimit limit(session, view);
    const auto planned = session.plan(wanted.base);
    if (!planned) return planned.error();
    for (const SkippedStage& skipped : planned->skipped)
        if (skipped.stage == wanted.stage) {
            report.skipped = skipped.reason;
            return report;
        }

    count_sorted(*frame, report);
    const Shares shares(wanted);
    tell("truth", 0);
    const auto row_truths = find_row_truths(session, wanted, *all, *frame);
    if (!row_truths) return row_truths.error();
    report.truths = truths_of(*row_truths);
    report.error_at = row_truths->error_at;
    report.no_picture = row_truths->no_picture;
    RowMaker maker(session, wanted, *all, *row_truths, report);
    const auto made = maker.make_all([&](std::string_view what, double done) { tell(what, shares.rows * done); });
    if (!made) return made.error();
    if (wanted.flicker && report.stopped.empty()) {
        const auto told = [&](std::string_view what, double done) { tell(what, shares.rows + shares.flicker * done); };
        const auto added = add_flicker(session, wanted, *all, report, told);
        if (!added && added.error().fault != Fault::stopped) return added.error();
        if (!added) report.stopped = "stopped before flicker was measured";
    }
    if (report.stopped.empty()) {
        const auto again =
            maker.time_again([&](std::string_view what, double done) { tell(what, 1 - shares.again * (1 - done)); });
        if (!again) return again.error();
    }
    if (!wanted.question.gpu.empty() && report.stopped.empty())
        if (const auto added = add_modeled_costs(session, wanted, report, progress); !added) return added.error();
    if (report.is_timed) mark_fronts(report.rows);
    if (wanted.wants_pictures) {
        tell("pictures", 1);
        const auto added = add_pictures(session, wanted, *all, *row_truths, report);
        if (!added && added.error().fault != Fault::stopped) return added.error();
        if (!added && report.stopped.empty()) report.stopped = "stopped before all pictures were made";
    }
    std::ranges::stable_sort(report.rows, {}, [](const Measurement& row) {
        return std::tuple(!row.is_measured(), row.has_other_truth, row.is_measured() ? ranking_metric(row).value : 0);
    });
    tell("done", 1);
    return report;
}

}  // namespace strata
