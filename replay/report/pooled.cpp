#include "replay/report/pooled.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <ranges>
#include <set>
#include <tuple>

#include "replay/plural.h"
#include "replay/report/variants.h"
#include "replay/report/warnings.h"

namespace strata {
namespace {

constexpr double least_figure = 1e-5;

/// A row of a frame.
struct Source {
    const Measurement* row;
    const Report* report;
    Standing asked;       ///< asked_standings()
    std::size_t capture;  ///< number
    std::string frame;    ///< PooledRow::worst_frame
    std::size_t place;    ///< PooledRow::worst_report
};

/// The geometric mean of a figure over rows; nothing when one of them lacks it.
std::optional<double> mean_of(std::span<const Source> rows,
                              const std::function<std::optional<double>(const Measurement&)>& metric) {
    std::vector<double> values;
    for (const Source& from : rows)
        if (const auto value = metric(*from.row)) values.push_back(*value);
    return values.empty() || values.size() < rows.size() ? std::nullopt : std::optional(geometric_mean(values));
}

double ranking_value(const Source& from) { return ranking_metric(*from.row).value; }

/// Over captures; of each its worst frame.
double pooled_error(std::span<const Source> rows, const RankingError& error) {
    std::map<std::size_t, double> worst;
    for (const Source& from : rows) {
        double& of_capture = worst[from.capture];
        of_capture = std::max(of_capture, ranking_value(from));
    }
    std::vector<double> errors;
    std::ranges::copy(std::views::values(worst), std::back_inserter(errors));
    if (!error.is_of_white) return geometric_mean(errors);
    return std::accumulate(errors.begin(), errors.end(), 0.) / double(errors.size());
}

/// Over all pixels that the stage changes: a frame weighs as many as it has.
std::optional<double> rms_of(std::span<const Source> rows, const RankingError& error) {
    double squares = 0, pixels = 0;
    for (const Source& from : rows) {
        if (!from.row->accuracy.footing || !error.is_of_white) return std::nullopt;
        const double own = double(from.row->accuracy.footing->pixels);
        squares += own * ranking_value(from) * ranking_value(from), pixels += own;
    }
    return pixels > 0 ? std::optional(std::sqrt(squares / pixels)) : std::nullopt;
}

/// Spread of the geometric mean of times, from their own spreads.
double spread_of_mean(double mean, std::span<const Standing> of) {
    double squares = 0;
    for (const Standing& each : of) squares += each.time > 0 ? std::pow(each.spread / each.time, 2) : 0;
    return mean * std::sqrt(squares) / double(of.size());
}

Standing asked_of(std::span<const Source> rows, double error) {
    std::vector<Standing> each;
    for (const Source& from : rows) each.push_back(from.asked);
    const auto most = [&](double Standing::*member) { return std::ranges::max(each, {}, member).*member; };
    std::vector<double> times;
    std::ranges::transform(each, std::back_inserter(times), &Standing::time);
    Standing made{.time = geometric_mean(times), .ms = most(&Standing::ms), .bytes = most(&Standing::bytes)};
    made.spread = spread_of_mean(made.time, each);
    made.ms_spread = std::ranges::max(each, {}, &Standing::ms).ms_spread;
    for (const Standing& one : each) made.bytes_per_pixel += one.bytes_per_pixel / double(each.size());
    made.bytes_per_pixel = std::round(made.bytes_per_pixel);
    if (std::ranges::all_of(each, [](const Standing& one) { return one.error.has_value(); })) made.error = error;
    return made;
}

PooledRow pooled_row(std::span<const Source> rows, const RankingError& error) {
    double bytes = 0;
    for (const Source& from : rows) bytes += from.row->bytes_per_pixel / double(rows.size());
    const Source& worst = *std::ranges::max_element(rows, {}, ranking_value);
    PooledRow made{
        .technique = rows.front().row->technique,
        .settings = rows.front().row->settings,
        .error = pooled_error(rows, error),
        .rms_error = rms_of(rows, error),
        .worst_error = ranking_value(worst),
        .worst_report = worst.place,
        .worst_frame = worst.frame,
        .time = mean_of(rows, [](const Measurement& row) { return row.time ? std::optional(row.time->median) : std::nullopt; }),
        .bytes_per_pixel = bytes,
        .flicker = mean_of(rows, [](const Measurement& row) { return row.flicker; }),
        .frames = rows.size(),
        .has_other_truth = std::ranges::any_of(rows, [](const Source& from) { return from.row->has_other_truth; })};
    if (made.time) {
        std::vector<Standing> times;
        for (const Source& from : rows) times.push_back({.time = from.row->time->median, .spread = from.row->time->mad});
        made.time_spread = spread_of_mean(*made.time, times);
    }
    made.asked = asked_of(rows, made.error);
    if (worst.report->question.is_asked()) made.command = command_of(*worst.report, *worst.row);
    return made;
}

/// The captures of reports by number: frames of one follow each other.
std::vector<std::size_t> captures_of(std::span<const Report> reports) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const bool follows = i > 0 && reports[i].capture_id == reports[i - 1].capture_id &&
                             reports[i].capture_name == reports[i - 1].capture_name && reports[i].frame > reports[i - 1].frame;
        numbers.push_back(i == 0 ? 0 : numbers.back() + (follows ? 0 : 1));
    }
    return numbers;
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

std::vector<std::string> frame_names(std::span<const Report> reports) {
    const std::vector<std::size_t> captures = captures_of(reports);
    std::vector<std::string> names;
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const bool is_alone = std::ranges::count(captures, captures[i]) == 1;
        names.push_back(is_alone ? reports[i].capture_name
                                 : fmt::format("{} frame {}", reports[i].capture_name, reports[i].frame));
    }
    return names;
}

Pool pooled(std::span<const Report> reports) {
    Pool pool;
    std::vector<std::vector<Source>> rows;  // of equal technique and settings
    bool one_unit = true;
    const std::vector<std::size_t> captures = captures_of(reports);
    const std::vector<std::string> names = frame_names(reports);
    std::optional<std::size_t> first_counted;
    std::set<std::size_t> counted;
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const Report& report = reports[i];
        pool.stage = report.stage, pool.question = report.question, pool.times_are = times_text(report);
        if (!report.skipped.empty() || !report.is_timed) continue;
        if (pool.without_modeled_time.empty()) pool.without_modeled_time = without_modeled_time(report);
        const bool is_of_another_kind = first_counted && report.error_at != reports[*first_counted].error_at;
        if (changes_too_little(report) || is_of_another_kind) {
            pool.left_out.push_back(names[i]);
            continue;
        }
        if (pool.frames == 0) pool.time_unit = report.time_unit;
        if (!first_counted) first_counted = i;
        one_unit = one_unit && report.time_unit == pool.time_unit;
        ++pool.frames;
        counted.insert(captures[i]);
        const std::vector<Standing> asked = asked_standings(report);
        for (std::size_t j = 0; j < report.rows.size(); ++j) {
            const Measurement& row = report.rows[j];
            if (!row.is_measured()) continue;
            pool.error = {ranking_metric(row).name, is_of_white(ranking_metric(row))};
            const auto same = [&](const auto& others) {
                const Measurement& other = *others.front().row;
                return std::tie(other.technique, other.settings) == std::tie(row.technique, row.settings);
            };
            auto known = std::ranges::find_if(rows, same);
            if (known == rows.end()) known = rows.emplace(known);
            known->push_back({&row, &report, asked[j], captures[i], names[i], i});
        }
    }
    pool.captures = counted.size();
    if (!one_unit) pool.time_unit.clear();
    for (const auto& same : rows) pool.rows.push_back(pooled_row(same, pool.error));
    mark_fronts(pool);
    std::ranges::stable_sort(pool.rows, {}, [&](const PooledRow& row) {
        return std::tuple(pool.frames - row.frames, row.has_other_truth, row.error);
    });
    return pool;
}

bool is_ranked(const Pool& pool, const PooledRow& row) { return row.frames == pool.frames && !row.has_other_truth; }

std::optional<std::size_t> baseline_of(const Pool& pool) {
    const auto found = std::ranges::find_if(pool.rows, [&](const PooledRow& row) {
        return row.technique == pool.time_unit && row.settings.empty() && row.frames == pool.frames;
    });
    return found == pool.rows.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - pool.rows.begin()));
}

std::vector<Standing> standings(const Pool& pool) {
    std::vector<Standing> all;
    for (const PooledRow& row : pool.rows) {
        Standing standing{
            .time = row.time.value_or(HUGE_VAL), .spread = row.time_spread, .bytes_per_pixel = std::round(row.bytes_per_pixel)};
        if (is_ranked(pool, row)) standing.error = row.error, standing.rounding = pool.error.rounding();
        all.push_back(standing);
    }
    return all;
}

namespace {

std::vector<Standing> asked_standings(const Pool& pool) {
    std::vector<Standing> all;
    for (const PooledRow& row : pool.rows) {
        all.push_back(row.asked);
        all.back().rounding = pool.error.rounding();
        if (!is_ranked(pool, row)) all.back().error.reset();
    }
    return all;
}

}  // namespace

std::string frames_text(const Pool& pool) {
    if (pool.frames == pool.captures) return plural(pool.captures, "capture");
    const std::string frames = plural(pool.frames, "frame");
    return pool.captures == 1 ? frames : fmt::format("{} of {}", frames, plural(pool.captures, "capture"));
}

Answer answer_of(const Pool& pool) { return find_answer(asked_standings(pool), baseline_of(pool), pool.question); }

bool is_unanswered(const Pool& pool) {
    const bool is_empty = pool.frames == 0 && pool.left_out.empty();
    return pool.question.is_asked() && !is_empty && !answer_of(pool).recommended;
}

std::vector<AnswerLine> answer_lines(const Pool& pool) {
    if (!pool.question.is_asked() || (pool.frames == 0 && pool.left_out.empty())) return {};
    if (pool.frames == 0)
        return {{"answer", fmt::format("none; the stage changes fewer than {} pixels of each frame", fewest_pixels)}};
    const std::vector<Standing> rows = asked_standings(pool);
    const auto baseline = baseline_of(pool);
    const bool has_unit = has_time_unit(pool.question, rows, baseline);
    AnswerNames names{.rows = {},
                      .error = pool.error,
                      .unit = has_unit && !pool.time_unit.empty() ? below_stage(pool.time_unit) : "",
                      .times_are = pool.times_are,
                      .without_time = pool.without_modeled_time,
                      .over = " over " + frames_text(pool)};
    for (const PooledRow& row : pool.rows) {
        names.rows.push_back(short_label(row));
        names.commands.push_back(row.command);
        const std::string mean = pool.captures > 1 ? fmt::format("in the mean, {} ", pool.error.text(row.worst_error)) : "";
        names.worst.push_back(fmt::format("{}on {}", mean, row.worst_frame));
    }
    return answer_lines(rows, baseline, pool.question, names);
}

}  // namespace strata
