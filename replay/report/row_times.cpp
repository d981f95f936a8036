#include "replay/report/row_times.h"

#include <algorithm>

#include "passes/stages.h"
#include "passes/technique.h"

namespace strata {
namespace {

void append(std::vector<double>& to, const std::vector<double>& from) { to.insert(to.end(), from.begin(), from.end()); }

/// The steps of the stage's technique. A row has the same ones in every run.
void append_steps(std::vector<std::pair<std::string, std::vector<double>>>& to, const Run& run, Stage stage) {
    std::size_t place = 0;
    for (const StepRecord& step : run.steps) {
        if (step.scope.kind != ScopeKind::pass || step.scope.stage != stage) continue;
        if (place == to.size()) to.emplace_back(step.name, std::vector<double>());
        append(to[place++].second, step.ms_by_repeat);
    }
}

}  // namespace

Result<void> RowTimes::time(std::vector<std::size_t> rows, std::size_t repeats, const Progress& progress) {
    if (rows.empty() || repeats == 0) return {};
    if (unit_ && std::ranges::count(rows, *unit_) == 0) rows.insert(rows.begin(), *unit_);
    std::vector<Request> requests;
    for (const std::size_t row : rows) {
        requests.push_back(all_[row].variant->request);
        requests.back().counted = !all_[row].invocations;
    }
    std::vector<std::size_t> keeping;  // rows that are timed in unchanged frames, too, after all others and the first time alone
    for (const std::size_t row : rows) {
        if (!all_[row].variant->technique->abilities.keeps_work || !all_[row].unchanged_ms.empty()) continue;
        keeping.push_back(row);
        requests.push_back(all_[row].variant->request);
        requests.back().unchanged = true;
    }
    const auto runs = session_->time(requests, repeats, progress);
    if (!runs) return runs.error();
    const std::string stage(name(stage_));
    std::vector<double> unit_ms;
    if (unit_) {
        const auto place = std::size_t(std::ranges::find(rows, *unit_) - rows.begin());
        unit_ms = (*runs)[place].stage_ms_by_repeat.at(stage);
        if (this->repeats(*unit_) == 0) has_unit_ = std::ranges::min(unit_ms) > 0;
    }
    for (std::size_t i = 0; i < keeping.size(); ++i)
        append(all_[keeping[i]].unchanged_ms, (*runs)[rows.size() + i].stage_ms_by_repeat.at(stage));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Row& row = all_[rows[i]];
        const Run& run = (*runs)[i];
        append(row.stage_ms, run.stage_ms_by_repeat.at(stage));
        append(row.frame_ms, run.frame_ms_by_repeat);
        append(row.unit_ms, unit_ms);
        if (const auto sorts = run.stage_sort_ms_by_repeat.find(stage); sorts != run.stage_sort_ms_by_repeat.end())
            append(row.sort_ms, sorts->second);
        append_steps(row.steps_ms, run, stage_);
        if (const auto bytes = run.stage_bytes.find(stage); bytes != run.stage_bytes.end()) row.bytes = bytes->second;
        if (const auto ran = run.stage_invocations.find(stage); ran != run.stage_invocations.end()) row.invocations = ran->second;
        row.counters.clear();
        std::ranges::copy_if(run.counters, std::back_inserter(row.counters),
                             [&](const CounterRecord& counter) { return counter.technique == row.variant->technique->name; });
    }
    return {};
}

void RowTimes::add_to(Measurement& measured, std::size_t index, const Report& report) const {
    const Row& row = all_[index];
    measured.stage_ms = spread_of(row.stage_ms);
    measured.frame_ms = spread_of(row.frame_ms);
    if (!row.sort_ms.empty()) measured.sort_ms = spread_of(row.sort_ms);
    if (!row.unchanged_ms.empty()) measured.unchanged_ms = spread_of(row.unchanged_ms);
    measured.repeats_ms = row.stage_ms;
    measured.steps.clear();
    if (!row.sort_ms.empty()) measured.steps.push_back({"sort on the CPU", spread_of(row.sort_ms)});
    for (const auto& [name, ms] : row.steps_ms) measured.steps.push_back({name, spread_of(ms)});
    if (has_unit()) {
        measured.time = ratio_of(row.stage_ms, row.unit_ms);
        measured.baseline_repeats_ms = row.unit_ms;
    }
    measured.stage_bytes = row.bytes;
    measured.bytes_per_pixel = double(row.bytes) / (double(report.width) * report.height);
    measured.invocations = row.invocations;
    measured.counters = row.counters;
}

}  // namespace strata
