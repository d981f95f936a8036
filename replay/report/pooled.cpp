#include "replay/report/pooled.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <tuple>

namespace strata {
namespace {

constexpr double least_figure = 1e-5;

/// A row and the name of its capture.
struct Source {
    const Measurement* row;
    std::string_view capture;
};

/// The mean of a figure over rows; nothing when one of them lacks it.
std::optional<double> mean_of(std::span<const Source> rows,
                              const std::function<std::optional<double>(const Measurement&)>& metric) {
    std::vector<double> values;
    for (const Source& from : rows)
        if (const auto value = metric(*from.row)) values.push_back(*value);
    return values.empty() || values.size() < rows.size() ? std::nullopt : std::optional(geometric_mean(values));
}

double ranking_value(const Source& from) { return ranking_metric(*from.row).value; }

double mean_error(std::span<const Source> rows, const RankingError& error) {
    std::vector<double> errors;
    std::ranges::transform(rows, std::back_inserter(errors), ranking_value);
    if (!error.is_of_white) return geometric_mean(errors);
    return std::accumulate(errors.begin(), errors.end(), 0.) / double(errors.size());
}

PooledRow pooled_row(std::span<const Source> rows, const RankingError& error) {
    double bytes = 0;
    for (const Source& from : rows) bytes += from.row->bytes_per_pixel / double(rows.size());
    const Source worst = *std::ranges::max_element(rows, {}, ranking_value);
    return {
        .technique = rows.front().row->technique,
        .settings = rows.front().row->settings,
        .error = mean_error(rows, error),
        .worst_error = ranking_value(worst),
        .worst_capture = std::string(worst.capture),
        .time = mean_of(rows, [](const Measurement& row) { return row.time ? std::optional(row.time->median) : std::nullopt; }),
        .bytes_per_pixel = bytes,
        .flicker = mean_of(rows, [](const Measurement& row) { return row.flicker; }),
        .captures = rows.size(),
        .has_other_truth = std::ranges::any_of(rows, [](const Source& from) { return from.row->has_other_truth; })};
}

void mark_fronts(Pool& pool) {
    const std::vector<Standing> all = standings(pool);
    const std::vector<bool> fast = pareto_front(all, &Standing::time), small = pareto_front(all, &Standing::bytes_per_pixel);
    for (std::size_t i = 0; i < pool.rows.size(); ++i) {
        pool.rows[i].on_front = fast[i] && pool.rows[i].time;
        pool.rows[i].on_memory_front = small[i];
    }
}

}  // namespace

double geometric_mean(std::span<const double> values) {
    double logs = 0;
    for (const double value : values) logs += std::log(std::max(value, least_figure));
    return values.empty() ? 0 : std::exp(logs / double(values.size()));
}

Pool pooled(std::span<const Report> reports) {
    Pool pool;
    std::vector<std::vector<Source>> rows;  // of equal technique and settings
    bool one_unit = true;
    for (const Report& report : reports) {
        pool.stage = report.stage;
        if (!report.skipped.empty() || !report.is_timed) continue;
        if (pool.captures == 0) pool.time_unit = report.time_unit;
        one_unit = one_unit && report.time_unit == pool.time_unit;
        ++pool.captures;
        for (const Measurement& row : report.rows) {
            if (row.accuracy.technique_errors.empty()) continue;
            pool.error = {ranking_metric(row).name, is_of_white(ranking_metric(row))};
            const auto same = [&](const auto& others) {
                const Measurement& other = *others.front().row;
                return std::tie(other.technique, other.settings) == std::tie(row.technique, row.settings);
            };
            auto known = std::ranges::find_if(rows, same);
            if (known == rows.end()) known = rows.emplace(known);
            known->push_back({&row, report.capture_name});
        }
    }
    if (!one_unit) pool.time_unit.clear();
    for (const auto& same : rows) pool.rows.push_back(pooled_row(same, pool.error));
    mark_fronts(pool);
    std::ranges::stable_sort(pool.rows, {}, [&](const PooledRow& row) {
        return std::tuple(pool.captures - row.captures, row.has_other_truth, row.error);
    });
    return pool;
}

std::vector<Standing> standings(const Pool& pool) {
    std::vector<Standing> all;
    for (const PooledRow& row : pool.rows) {
        Standing standing{.time = row.time.value_or(HUGE_VAL), .bytes_per_pixel = std::round(row.bytes_per_pixel)};
        if (row.captures == pool.captures && !row.has_other_truth) standing.error = row.error;
        all.push_back(standing);
    }
    return all;
}

}  // namespace strata
