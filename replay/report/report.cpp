#include "replay/report/report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "passes/scene/object_order.h"
#include "replay/plural.h"
#include "replay/report/enough_repeats.h"
#include "replay/report/flicker.h"
#include "replay/report/picture_error.h"
#include "replay/report/variants.h"

namespace strata {
namespace {

// Samples up to which the truth and the models in double take seconds; above, an exact technique stands in.
constexpr std::uint64_t largest_truth = 640 * 360;
// How exact the stand-in must be at the extent where the truth is affordable: the root mean square of each texel's error relative
// to that texel (an exact technique's model is the truth). Relative to the whole frame's mean, one highlight of clear glass, of
// radiance 1027 in a frame of 0.3, would be all of the figure.
constexpr double stand_in_tolerance = 1e-4;

/// What the rows are measured against, and the extent at which models are affordable.
struct Yardstick {
    ImageSet truth;
    std::string name;
    std::uint32_t model_divisor = 1;
    std::optional<PictureTruth> picture = {};  ///< with ErrorAt::picture
};

std::uint32_t affordable_divisor(const View& view) {
    std::uint32_t divisor = 1;
    while (std::uint64_t(view.width / divisor) * (view.height / divisor) * view.samples > largest_truth) ++divisor;
    return divisor;
}

Result<Yardstick> find_yardstick(Session& session, const ReportRequest& wanted, const View& view) {
    Yardstick yardstick{.name = "exact, in double", .model_divisor = affordable_divisor(view)};
    if (yardstick.model_divisor == 1) {
        auto truth = session.truth(wanted.base, wanted.stage);
        if (!truth) return truth.error();
        yardstick.truth = *std::move(truth);
        return yardstick;
    }
    for (const Technique* technique : techniques_of(wanted.stage)) {
        if (!technique->abilities.stands_in_for_truth) continue;
        Request request = wanted.base;
        request.choices.use(*technique);
        Request reduced = request;
        reduced.variant.extent_divisor = yardstick.model_divisor;
        const auto accuracy = session.judge(reduced, wanted.stage, Against::model);
        if (!accuracy) return accuracy.error();
        if (!accuracy->not_supported.empty() || accuracy->model_rmse > stand_in_tolerance) continue;
        request.outputs.assign(info(wanted.stage).outputs.begin(), info(wanted.stage).outputs.end());
        const auto run = session.run(request);
        if (!run) return run.error();
        for (const auto& [name, image] : run->images) yardstick.truth.emplace(name, in_double(image));
        yardstick.name = fmt::format("{} stands in (relative rmse {:.1e} against the truth at 1/{} extent)", technique->name,
                                     accuracy->model_rmse, yardstick.model_divisor);
        return yardstick;
    }
    return fail(Fault::usage,
                "{} x {} at {} per pixel is too large for the truth of {} in double, and no technique can stand in; record a "
                "smaller frame",
                view.width, view.height, plural(view.samples, "sample"), name(wanted.stage));
}

Result<Accuracy> measure_stage(Session& session, const Variant& variant, Stage stage, const Yardstick& yardstick) {
    if (yardstick.model_divisor == 1) return session.judge(variant.request, stage, Against::model_and_truth, &yardstick.truth);
    auto accuracy = session.judge(variant.request, stage, Against::truth, &yardstick.truth);
    if (!accuracy || !accuracy->not_supported.empty()) return accuracy;
    Request reduced = variant.request;
    reduced.variant.extent_divisor = yardstick.model_divisor;
    const auto model = session.judge(reduced, stage, Against::model);
    if (!model) return model.error();
    accuracy->model_rmse = model->model_rmse;
    accuracy->model_worst = model->model_worst;
    if (accuracy->incomparable.empty()) accuracy->incomparable = model->incomparable;
    return accuracy;
}

Result<Accuracy> measure_accuracy(Session& session, const Variant& variant, Stage stage, const Yardstick& yardstick) {
    auto accuracy = measure_stage(session, variant, stage, yardstick);
    if (!accuracy || !accuracy->not_supported.empty() || !yardstick.picture) return accuracy;
    const auto judged = judge_picture(session, variant.request, *yardstick.picture, *accuracy);
    return judged ? std::move(accuracy) : Result<Accuracy>(judged.error());
}

/// What a timed run gave, in its row.
void add_timing(Measurement& row, const Run& run, const Report& report) {
    const std::string stage_name(name(report.stage));
    row.stage_ms = run.stage_ms.at(stage_name);
    row.frame_ms = *run.frame_ms;
    if (const auto sorted = run.stage_sort_ms.find(stage_name); sorted != run.stage_sort_ms.end()) row.sort_ms = sorted->second;
    if (const auto bytes = run.stage_bytes.find(stage_name); bytes != run.stage_bytes.end()) row.stage_bytes = bytes->second;
    row.bytes_per_pixel = double(row.stage_bytes) / (double(report.width) * report.height);
    if (const auto ran = run.stage_invocations.find(stage_name); ran != run.stage_invocations.end())
        row.invocations = ran->second;
    std::ranges::copy_if(run.counters, std::back_inserter(row.counters),
                         [&](const CounterRecord& counter) { return counter.technique == row.technique; });
}

/// The stage's time, and in multiples of the unit's in the same turns, which has times in every turn that the row has; null: no
/// unit.
void add_times(Measurement& row, const Run& run, const Run* unit, Stage stage) {
    const std::string stage_name(name(stage));
    const std::vector<double>& times = run.stage_ms_by_repeat.at(stage_name);
    row.stage_ms = spread_of(times);
    if (!unit) return;
    std::vector<double> units;
    for (const std::size_t turn : run.turns) units.push_back(unit->stage_ms_by_repeat.at(stage_name).at(turn));
    if (!units.empty() && std::ranges::min(units) > 0) row.time = ratio_of(times, units);
}

/// Repeats that every row has: all of them, or fewer where rows are timed again only while their place is uncertain.
std::size_t least_repeats_of(const Report& report) {
    return report.least_repeats > 0 ? std::min(report.least_repeats, report.repeats) : report.repeats;
}

/// Times of all rows that can do the frame, and the same in units of the technique whose time is the unit.
Result<void> time_rows(Session& session, std::span<const Variant> all, Report& report, const Progress& tell) {
    std::vector<Request> timed;
    std::vector<std::size_t> places;  // in the report, of what is timed
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!report.rows[i].accuracy.not_supported.empty()) continue;
        timed.push_back(all[i].request);
        places.push_back(i);
    }
    const auto times = [&](const Run& run) { return run.stage_ms_by_repeat.at(std::string(name(report.stage))); };
    // At its defaults, where they are measured.
    const auto is_unit = [&](std::size_t i) { return all[i].technique->abilities.is_time_unit; };
    auto unit = std::ranges::find_if(places, [&](std::size_t i) { return is_unit(i) && all[i].settings.empty(); });
    if (unit == places.end()) unit = std::ranges::find_if(places, is_unit);
    const std::size_t unit_place = std::size_t(unit - places.begin());
    const Repeats repeats{.least = least_repeats_of(report), .most = report.repeats, .again = [&](std::span<const Run> so_far) {
                              std::vector<Measurement> rows;
                              for (std::size_t i = 0; i < places.size(); ++i) {
                                  rows.push_back({.accuracy = report.rows[places[i]].accuracy});
                                  add_times(rows.back(), so_far[i], unit == places.end() ? nullptr : &so_far[unit_place],
                                            report.stage);
                              }
                              std::vector<bool> again = uncertain_rows(standings(rows), report.question);
                              if (unit != places.end() && std::ranges::count(again, true) > 0) again[unit_place] = true;
                              return again;
                          }};
    const auto runs = session.time_until(timed, repeats, tell);
    if (!runs) return runs.error();
    std::vector<double> unit_times;
    if (unit != places.end()) unit_times = times((*runs)[unit_place]);
    const bool measurable = !unit_times.empty() && std::ranges::min(unit_times) > 0;  // 0: a clock too coarse for the frame
    if (measurable) report.time_unit = all[*unit].technique->name;
    for (std::size_t i = 0; i < places.size(); ++i) {
        Measurement& row = report.rows[places[i]];
        add_timing(row, (*runs)[i], report);
        add_times(row, (*runs)[i], measurable ? &(*runs)[unit_place] : nullptr, report.stage);
    }
    if (runs->empty()) return {};
    const auto repeats_of = [](const Run& run) { return run.turns.size(); };
    const std::size_t done = std::ranges::max(*runs, {}, repeats_of).turns.size();
    report.least_repeats = std::ranges::min(*runs, {}, repeats_of).turns.size();
    const bool is_enough = done >= repeats.least && (done >= repeats.most || std::ranges::count(repeats.again(*runs), true) == 0);
    if (!is_enough) report.stopped = fmt::format("stopped after {} of {} timed runs", done, report.repeats);
    report.repeats = done;
    return {};
}

/// Flicker of all rows that can do the frame.
Result<void> add_flicker(Session& session, ReportRequest wanted, std::span<const Variant> all, Report& report,
                         const Progress& tell) {
    if (!wanted.flicker->dolly) {
        const auto frame = session.frame(wanted.base.variant.frame);
        if (!frame) return frame.error();
        wanted.flicker->dolly = default_dolly(*frame);
        if (!wanted.flicker->dolly) return fail(Fault::usage, "nothing lies before the eye to move towards; give --dolly metres");
    }
    report.flicker = wanted.flicker;
    std::vector<Request> moved;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (report.rows[i].accuracy.not_supported.empty()) moved.push_back(all[i].request);
    const auto flickers = measure_flicker(session, wanted, moved, tell);
    if (!flickers) return flickers.error();
    auto flicker = flickers->begin();
    for (Measurement& row : report.rows)
        if (row.accuracy.not_supported.empty()) row.flicker = *flicker++;
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

/// Progress of a report whose steps take, in units of one run, about 4 for a row's errors, a run per frame of its flicker, and
/// one per timed run and the one that warms up.
struct Shares {
    double errors = 4, flicker = 0, times = 0;
    explicit Shares(const ReportRequest& wanted)
        : flicker(wanted.flicker ? wanted.flicker->frames : 0), times(double(wanted.repeats + 1)) {
        const double all = errors + flicker + times;
        errors /= all, flicker /= all, times /= all;
    }
};

}  // namespace

const Figure& ranking_figure(const Measurement& row) {
    const std::vector<Figure>& figures = row.accuracy.touched.empty() ? row.accuracy.method : row.accuracy.touched;
    const auto relative = std::ranges::find(figures, "relative rmse", &Figure::name);
    return relative == figures.end() ? figures.front() : *relative;
}

std::string ranking_name(const Measurement& row) {
    const bool is_touched = !row.accuracy.touched.empty() && row.accuracy.touched_share < 1;
    return ranking_figure(row).name + (is_touched ? " touched" : "");
}

std::vector<Standing> standings(std::span<const Measurement> rows) {
    std::vector<Standing> all;
    for (const Measurement& row : rows) {
        Standing standing{.time = row.time ? row.time->median : row.stage_ms.median,
                          .spread = row.time ? row.time->mad : row.stage_ms.mad,
                          .bytes_per_pixel = std::round(row.bytes_per_pixel)};
        if (!row.accuracy.method.empty()) standing.error = ranking_figure(row).value;
        all.push_back(standing);
    }
    return all;
}

std::optional<std::size_t> baseline_of(const Report& report) {
    const auto found = std::ranges::find_if(report.rows, [&](const Measurement& row) {
        return row.technique == report.time_unit && row.settings.empty() && row.accuracy.not_supported.empty();
    });
    return found == report.rows.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - report.rows.begin()));
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

std::vector<Figure> errors_of(const Measurement& row) {
    std::vector<Figure> errors = row.accuracy.method;
    if (row.accuracy.flip) errors.push_back({"FLIP", "", *row.accuracy.flip});
    return errors;
}

Result<Report> make_report(Session& session, const ReportRequest& wanted, const Progress& progress) {
    const auto tell = [&](std::string_view what, double done) {
        if (progress) progress(what, done);
    };
    if (techniques_of(wanted.stage).empty()) return fail(Fault::usage, "the stage {} has no technique yet", name(wanted.stage));
    const auto all = variants(wanted);
    if (!all) return all.error();
    const auto frame = session.frame(wanted.base.variant.frame);
    if (!frame) return frame.error();
    View view = frame->view;
    if (wanted.base.variant.samples) view.samples = wanted.base.variant.samples;

    Report report{.stage = wanted.stage,
                  .capture_id = session.capture_id(),
                  .error_at = wanted.error_at,
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
    auto yardstick = find_yardstick(session, wanted, view);
    if (!yardstick) return yardstick.error();
    if (wanted.error_at == ErrorAt::picture) {
        auto picture = picture_truth(session, wanted.base, wanted.stage, yardstick->truth);
        if (!picture) return picture.error();
        yardstick->picture = *std::move(picture);
    }
    report.truth = yardstick->name;
    for (std::size_t i = 0; i < all->size(); ++i) {
        const Variant& variant = (*all)[i];
        const Tolerance tolerance = tolerance_at(variant.technique->tolerance, variant.settings, {});
        report.rows.push_back({.technique = std::string(variant.technique->name),
                               .settings = variant.settings,
                               .tolerance = tolerance.rmse,
                               .tolerated_worst = tolerance.worst,
                               .model_is = variant.technique->model_is});
        tell(fmt::format("{} of {}, {}", i + 1, all->size(), label(variant.technique->name, variant.settings)),
             shares.errors * double(i) / double(all->size()));
        auto accuracy = measure_accuracy(session, variant, wanted.stage, *yardstick);
        if (!accuracy && accuracy.error().fault == Fault::stopped && i > 0) {
            report.rows.pop_back();
            report.stopped = fmt::format("stopped after the errors of {} of {} rows; no time was measured", i, all->size());
            report.is_timed = false;
            break;
        }
        if (!accuracy) return accuracy.error();
        report.rows.back().accuracy = *std::move(accuracy);
        if (wanted.on_row) wanted.on_row(report.rows.back(), i + 1, all->size());
    }
    if (wanted.flicker && report.stopped.empty()) {
        const auto told = [&](std::string_view what, double done) { tell(what, shares.errors + shares.flicker * done); };
        const auto added = add_flicker(session, wanted, *all, report, told);
        if (!added && added.error().fault != Fault::stopped) return added.error();
        if (!added) report.stopped = "stopped before flicker and times were measured", report.is_timed = false;
    }
    if (report.stopped.empty()) {
        const auto told = [&](std::string_view what, double done) { tell(what, 1 - shares.times * (1 - done)); };
        const auto timed = time_rows(session, *all, report, told);
        if (!timed && timed.error().fault != Fault::stopped) return timed.error();
        if (!timed) report.stopped = "stopped before a time was measured";
        report.is_timed = bool(timed);
    }
    if (report.is_timed) mark_fronts(report.rows);
    std::ranges::stable_sort(report.rows, {}, [](const Measurement& row) {
        return row.accuracy.method.empty() ? HUGE_VAL : ranking_figure(row).value;
    });
    tell("done", 1);
    return report;
}

}  // namespace strata
