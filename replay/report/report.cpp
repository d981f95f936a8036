#include "replay/report/report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "passes/scene/object_order.h"
#include "replay/measure/host_memory.h"
#include "replay/plural.h"
#include "replay/report/enough_repeats.h"
#include "replay/report/flicker.h"
#include "replay/report/picture_error.h"
#include "replay/report/row_times.h"
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

/// Repeats that every row has: all of them, or fewer where rows are timed again only while their place is uncertain.
std::size_t least_repeats_of(const ReportRequest& wanted) {
    return wanted.least_repeats > 0 ? std::min(wanted.least_repeats, wanted.repeats) : wanted.repeats;
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

/// Rows that are timed beside each other. A row waits for the others of its group until its times are known, and the pipelines of
/// a group are kept; but each group runs the unit, too, and what comes before the stage.
constexpr std::size_t group_size = 8;

/// Whose time may be the unit first, at its defaults before its other settings: each group has it beside its rows.
void put_unit_first(std::vector<Variant>& rows) {
    std::ranges::stable_sort(
        rows, {}, [](const Variant& row) { return row.technique->abilities.is_time_unit ? (row.settings.empty() ? 0 : 1) : 2; });
}

/// Makes the rows of a report one group after the other, and times again those whose place is not certain.
class RowMaker {
public:
    RowMaker(Session& session, const ReportRequest& wanted, std::span<const Variant> all, const Yardstick& yardstick,
             Report& report)
        : session_(&session),
          wanted_(&wanted),
          all_(all),
          yardstick_(&yardstick),
          report_(&report),
          times_(session, wanted.stage, all) {}

    /// Errors and times. Stopped, the report has the complete groups; if there is none, the rows whose errors are known.
    Result<void> make_all(const Progress& tell) {
        while (report_->rows.size() < all_.size() && report_->stopped.empty()) {
            release_freed_memory();
            const std::size_t begin = report_->rows.size(), end = std::min(begin + group_size, all_.size());
            if (const auto made = make_group(end, tell); made) continue;
            else if (made.error().fault != Fault::stopped || report_->rows.empty()) return made;
            if (begin == 0) {
                report_->is_timed = false;
                report_->stopped = fmt::format("stopped after the errors of {} of {} rows; no time was measured",
                                               report_->rows.size(), all_.size());
            } else {
                report_->rows.resize(begin);
                report_->stopped = fmt::format("stopped after {} of {} rows", begin, all_.size());
            }
        }
        count_repeats();
        return {};
    }
    /// Times the rows whose place is uncertain as often as rows are timed at most.
    Result<void> time_again(const Progress& tell) {
        const std::size_t most = wanted_->repeats, least = least_repeats_of(*wanted_);
        if (most == least) return {};
        const std::vector<bool> uncertain = uncertain_rows(standings(report_->rows), wanted_->question);
        std::vector<std::size_t> rows;
        for (std::size_t i = 0; i < uncertain.size(); ++i)
            if (uncertain[i] && i != unit_) rows.push_back(i);
        for (std::size_t begin = 0; begin < rows.size() && report_->stopped.empty(); begin += group_size) {
            const std::span group = std::span(rows).subspan(begin, std::min(group_size, rows.size() - begin));
            const auto told = [&](std::string_view what, double done) {
                tell(fmt::format("{} of {} once more, {}", plural(rows.size(), "row"), all_.size(), what),
                     (double(begin) + done * double(group.size())) / double(rows.size()));
            };
            const std::size_t before = times_.repeats(group.front());
            const auto timed = times_.time({group.begin(), group.end()}, most - least, told);
            if (!timed && timed.error().fault != Fault::stopped) return timed;
            const std::size_t done = times_.repeats(group.front()) - before;
            if (done < most - least)
                report_->stopped =
                    fmt::format("stopped after {} of {} timed runs of rows whose rank is open", done, most - least);
            for (const std::size_t i : group) times_.add_to(report_->rows[i], i, *report_);
        }
        if (unit_) times_.add_to(report_->rows[*unit_], *unit_, *report_);
        count_repeats();
        return {};
    }

private:
    Result<void> make_group(std::size_t end, const Progress& tell) {
        const std::size_t begin = report_->rows.size();
        for (std::size_t i = begin; i < end; ++i) {
            const Variant& variant = all_[i];
            tell(fmt::format("{} of {}, {}", i + 1, all_.size(), label(variant.technique->name, variant.settings)),
                 double(i) / double(all_.size()));
            auto accuracy = measure_accuracy(*session_, variant, wanted_->stage, *yardstick_);
            if (!accuracy) return accuracy.error();
            const Tolerance tolerance = tolerance_at(variant.technique->tolerance, variant.settings, {});
            report_->rows.push_back({.technique = std::string(variant.technique->name),
                                     .settings = variant.settings,
                                     .accuracy = *std::move(accuracy),
                                     .tolerance = tolerance.rmse,
                                     .tolerated_worst = tolerance.worst,
                                     .model_is = variant.technique->model_is});
            if (!unit_ && is_supported(i) && variant.technique->abilities.is_time_unit) times_.set_unit(*(unit_ = i));
        }
        std::vector<std::size_t> timed;
        for (std::size_t i = begin; i < end; ++i)
            if (is_supported(i)) timed.push_back(i);
        const auto told = [&](std::string_view what, double) {
            tell(fmt::format("{} to {} of {}, {}", begin + 1, end, all_.size(), what), double(end) / double(all_.size()));
        };
        const std::size_t least = least_repeats_of(*wanted_), first = least < wanted_->repeats ? 1 : least;
        if (const auto done = times_.time(timed, first, told); !done) return done;
        if (times_.has_unit()) report_->time_unit = all_[*unit_].technique->name;
        for (const std::size_t i : timed) times_.add_to(report_->rows[i], i, *report_);
        const std::vector<bool> are_far_behind = rows_far_behind(standings(report_->rows), unit_);
        std::erase_if(timed, [&](std::size_t i) { return are_far_behind[i]; });
        const auto done = times_.time(timed, least - first, told);
        if (!done && done.error().fault != Fault::stopped) return done;
        for (const std::size_t i : timed) {
            if (times_.repeats(i) < least)
                report_->stopped = end < all_.size() ? fmt::format("stopped after {} of {} rows", end, all_.size())
                                                     : fmt::format("stopped after {} of {} timed runs", times_.repeats(i), least);
            times_.add_to(report_->rows[i], i, *report_);
        }
        for (std::size_t i = begin; i < end && wanted_->on_row; ++i) wanted_->on_row(report_->rows[i], i + 1, all_.size());
        return {};
    }
    bool is_supported(std::size_t row) const { return report_->rows[row].accuracy.not_supported.empty(); }
    void count_repeats() {
        report_->repeats = 0;
        report_->least_repeats = wanted_->repeats;
        bool are_others_timed = false;
        for (std::size_t i = 0; i < report_->rows.size(); ++i)
            are_others_timed = are_others_timed || (i != unit_ && times_.repeats(i) > 0);
        for (std::size_t i = 0; i < report_->rows.size(); ++i) {
            if (times_.repeats(i) == 0 || (i == unit_ && are_others_timed)) continue;
            report_->repeats = std::max(report_->repeats, times_.repeats(i));
            report_->least_repeats = std::min(report_->least_repeats, times_.repeats(i));
        }
    }

    Session* session_;
    const ReportRequest* wanted_;
    std::span<const Variant> all_;
    const Yardstick* yardstick_;
    Report* report_;
    RowTimes times_;
    std::optional<std::size_t> unit_;
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
    auto all = variants(wanted);
    if (!all) return all.error();
    put_unit_first(*all);
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
    RowMaker maker(session, wanted, *all, *yardstick, report);
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
    if (report.is_timed) mark_fronts(report.rows);
    std::ranges::stable_sort(report.rows, {}, [](const Measurement& row) {
        return row.accuracy.method.empty() ? HUGE_VAL : ranking_figure(row).value;
    });
    tell("done", 1);
    return report;
}

}  // namespace strata
