#include "replay/report/row_maker.h"

#include <algorithm>

#include "passes/technique.h"
#include "replay/plural.h"
#include "replay/report/enough_repeats.h"

namespace strata {
namespace {

/// Rows that are timed beside each other. A row waits for the others of its group until its times are known, and the pipelines of
/// a group are kept; but each group runs the unit, too, and what comes before the stage.
constexpr std::size_t rows_at_once = 4;

}  // namespace

std::size_t least_repeats_of(const ReportRequest& wanted) {
    return wanted.least_repeats > 0 ? std::min(wanted.least_repeats, wanted.repeats) : wanted.repeats;
}

Result<void> RowMaker::make_all(const Progress& tell) {
    while (report_->rows.size() < all_.size() && report_->stopped.empty()) {
        const std::size_t begin = report_->rows.size(), end = std::min(begin + rows_at_once, all_.size());
        if (const auto made = make_group(end, tell); made) continue;
        else if (made.error().fault != Fault::stopped || report_->rows.empty()) return made;
        if (begin == 0) {
            report_->is_timed = false;
            report_->stopped =
                fmt::format("stopped after the errors of {} of {} rows; no time was measured", report_->rows.size(), all_.size());
        } else {
            report_->rows.resize(begin);
            report_->stopped = fmt::format("stopped after {} of {} rows", begin, all_.size());
        }
    }
    count_repeats();
    return {};
}

Result<void> RowMaker::time_again(const Progress& tell) {
    const std::size_t most = wanted_->repeats, least = least_repeats_of(*wanted_);
    if (most == least) return {};
    const std::vector<bool> uncertain = uncertain_rows(standings(report_->rows), wanted_->question);
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < uncertain.size(); ++i)
        if (uncertain[i] && i != times_.unit()) rows.push_back(i);
    for (std::size_t begin = 0; begin < rows.size() && report_->stopped.empty(); begin += rows_at_once) {
        const std::span group = std::span(rows).subspan(begin, std::min(rows_at_once, rows.size() - begin));
        const auto told = [&](std::string_view what, double done) {
            tell(fmt::format("{} of {} once more, {}", plural(rows.size(), "row"), all_.size(), what),
                 (double(begin) + done * double(group.size())) / double(rows.size()));
        };
        const std::size_t before = times_.repeats(group.front());
        const auto timed = times_.time({group.begin(), group.end()}, most - least, told);
        if (!timed && timed.error().fault != Fault::stopped) return timed;
        const std::size_t done = times_.repeats(group.front()) - before;
        if (done < most - least)
            report_->stopped = fmt::format("stopped after {} of {} timed runs of rows whose rank is open", done, most - least);
        for (const std::size_t i : group) times_.add_to(report_->rows[i], i, *report_);
    }
    if (const auto unit = times_.unit()) times_.add_to(report_->rows[*unit], *unit, *report_);
    count_repeats();
    return {};
}

Result<void> RowMaker::make_group(std::size_t end, const Progress& tell) {
    const std::size_t begin = report_->rows.size();
    for (std::size_t i = begin; i < end; ++i) {
        const Variant& variant = all_[i];
        session_->give_back_memory();
        tell(fmt::format("{} of {}, {}", i + 1, all_.size(), label(variant.technique->name, variant.settings)),
             double(i) / double(all_.size()));
        const RowTruth& row_truth = row_truths_->all[row_truths_->of_row[i]];
        auto accuracy = measure_accuracy(*session_, variant, wanted_->stage, row_truth);
        if (!accuracy) return accuracy.error();
        const Tolerance tolerance = tolerance_at(variant.technique->tolerance, variant.settings, {});
        report_->rows.push_back({.technique = std::string(variant.technique->name),
                                 .settings = variant.settings,
                                 .truth = std::string(row_truth.of.name),
                                 .has_other_truth = row_truths_->of_row[i] != row_truths_->of_row.front(),
                                 .ranked_by = wanted_->ranked_by,
                                 .accuracy = *std::move(accuracy),
                                 .tolerance = tolerance.rmse,
                                 .tolerated_worst = tolerance.worst,
                                 .model_is = variant.technique->model_is});
        if (!times_.unit() && is_supported(i) && variant.technique->abilities.is_time_unit) times_.set_unit(i);
    }
    std::vector<std::size_t> timed;
    for (std::size_t i = begin; i < end; ++i)
        if (is_supported(i)) timed.push_back(i);
    const auto told = [&](std::string_view what, double) {
        tell(fmt::format("{} to {} of {}, {}", begin + 1, end, all_.size(), what), double(end) / double(all_.size()));
    };
    const std::size_t least = least_repeats_of(*wanted_), first = least < wanted_->repeats ? 1 : least;
    if (const auto done = times_.time(timed, first, told); !done) return done;
    if (times_.has_unit()) report_->time_unit = all_[*times_.unit()].technique->name;
    for (const std::size_t i : timed) times_.add_to(report_->rows[i], i, *report_);
    const std::vector<bool> are_far_behind = rows_far_behind(standings(report_->rows));
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

void RowMaker::count_repeats() {
    report_->repeats = 0;
    report_->least_repeats = wanted_->repeats;
    bool are_others_timed = false;
    for (std::size_t i = 0; i < report_->rows.size(); ++i)
        are_others_timed = are_others_timed || (i != times_.unit() && times_.repeats(i) > 0);
    for (std::size_t i = 0; i < report_->rows.size(); ++i) {
        if (times_.repeats(i) == 0 || (i == times_.unit() && are_others_timed)) continue;
        report_->repeats = std::max(report_->repeats, times_.repeats(i));
        report_->least_repeats = std::min(report_->least_repeats, times_.repeats(i));
    }
}

}  // namespace strata
