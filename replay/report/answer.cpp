#include "replay/report/answer.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "replay/plural.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

// A time with a larger spread, as a share of it, is told apart from hardly any other: a busy machine, or too few repeats.
constexpr double largest_spread = .25;

bool keeps_error(const Standing& row, const Question& asked) { return row.error && (!asked.error || *row.error <= *asked.error); }

bool keeps_time(const Standing& row, const Question& asked) {
    return row.error && (!asked.within || row.time + row.spread <= *asked.within) &&
           (!asked.within_ms || row.ms + row.ms_spread <= *asked.within_ms);
}

bool keeps_memory(const Standing& row, const Question& asked) {
    return row.error && (!asked.memory || row.bytes <= *asked.memory);
}

bool keeps_all(const Standing& row, const Question& asked) {
    return keeps_error(row, asked) && keeps_time(row, asked) && keeps_memory(row, asked);
}

/// The factor by which a ranked row exceeds the limit that it exceeds most.
double excess(const Standing& row, const Question& asked) {
    const auto factor = [](const std::optional<double>& limit, double value) { return limit ? value / *limit : 0; };
    return std::max({factor(asked.error, *row.error), factor(asked.within, row.time + row.spread),
                     factor(asked.within_ms, row.ms + row.ms_spread), factor(asked.memory, row.bytes)});
}

/// Whether two rows cost the same, as far as can be told.
bool cost_the_same(const Standing& a, const Standing& b, Cost cost) {
    return cost == &Standing::time ? are_level(a, b) : a.*cost == b.*cost;
}

/// The first row with the least value of those that are candidates.
template <typename Keeps, typename Value>
std::optional<std::size_t> least(std::span<const Standing> rows, const Keeps& keeps, const Value& value) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (keeps(rows[i]) && (!best || value(rows[i]) < value(rows[*best]))) best = i;
    return best;
}

/// "1.5 MiB".
std::string size_text(double bytes) {
    constexpr std::array units{"bytes", "KiB", "MiB", "GiB"};
    std::size_t unit = 0;
    for (; bytes >= 1024 && unit + 1 < units.size(); ++unit) bytes /= 1024;
    return fmt::format("{} {}", short_number(bytes), units[unit]);
}

/// The costs that are asked for, or that rows are compared by.
std::string costs(const Standing& row, const Question& asked, const AnswerNames& names) {
    std::string text;
    const char* modeled = asked.gpu.empty() ? "" : " modeled";
    if (!names.unit.empty()) text += fmt::format(", {:.2f}x{}", row.time, modeled);
    if (asked.within_ms) text += fmt::format(", {} ms{}", short_number(row.ms), modeled);
    return text + (asked.memory ? ", " + size_text(row.bytes) : fmt::format(", {} bytes per pixel", row.bytes_per_pixel));
}

std::string limits(const Question& asked, const AnswerNames& names) {
    std::vector<std::string> each;
    if (asked.error) each.push_back(fmt::format("{} up to {}", names.error.name, names.error.text(*asked.error)));
    if (asked.within) each.push_back(fmt::format("within {}x of {}", short_number(*asked.within), names.unit));
    if (asked.within_ms) each.push_back(fmt::format("within {} ms", short_number(*asked.within_ms)));
    if (asked.memory) each.push_back("in " + size_text(*asked.memory));
    return fmt::format("{}", fmt::join(each, " "));
}

/// The number of quantities that are limited: error, time, memory.
int limited(const Question& asked) {
    return int(asked.error.has_value()) + int(asked.within || asked.within_ms) + int(asked.memory.has_value());
}

/// The limits that a row does not keep: "the limit of error", "both limits".
std::string missed(const Standing& row, const Question& asked) {
    std::vector<std::string> which;
    if (!keeps_error(row, asked)) which.emplace_back("error");
    if (!keeps_time(row, asked)) which.emplace_back("time");
    if (!keeps_memory(row, asked)) which.emplace_back("memory");
    if (which.size() > 1 && int(which.size()) == limited(asked)) return which.size() == 2 ? "both limits" : "all three limits";
    return fmt::format("the limit{} of {}", which.size() > 1 ? "s" : "", fmt::join(which, " and "));
}

/// Lines of an answer, each a sentence about a row.
class AnswerLines {
public:
    AnswerLines(std::span<const Standing> rows, std::optional<std::size_t> baseline, const Question& asked,
                const AnswerNames& names)
        : rows_(rows), baseline_(baseline), asked_(asked), names_(names), answer_(find_answer(rows, baseline, asked)) {}

    std::vector<AnswerLine> lines() const {
        std::vector<AnswerLine> lines = answer_.recommended ? recommendation() : nearest();
        lines.front().head = fmt::format("answer{}{} ", names_.over, asked_.error ? " for" : "") + limits(asked_, names_);
        if (!names_.without_time.empty()) lines.insert(lines.begin(), {"without a modeled time", names_.without_time});
        if (!names_.times_are.empty()) lines.insert(lines.begin(), {"", names_.times_are});
        const auto shown = answer_.recommended ? answer_.recommended : answer_.nearest;
        if (baseline_ && baseline_ != shown && rows_[*baseline_].error)
            lines.push_back({"", fmt::format("the baseline {} {}{}", row(*baseline_),
                                             keeps_all(rows_[*baseline_], asked_) ? "keeps it, too"
                                                                                  : "misses " + missed(rows_[*baseline_], asked_),
                                             note())});
        if (shown && *shown < names_.commands.size()) lines.push_back({std::string(replay_head), names_.commands[*shown]});
        return lines;
    }

private:
    std::string row(std::size_t i) const {
        const std::string worst = i < names_.worst.size() ? " " + names_.worst[i] : "";
        return fmt::format("{} ({} {}{}{})", names_.rows[i], names_.error.name, names_.error.text(*rows_[i].error), worst,
                           costs(rows_[i], asked_, names_));
    }
    std::string note() const { return names_.baseline_note.empty() ? "" : "; " + names_.baseline_note; }

    std::vector<AnswerLine> recommendation() const {
        const std::size_t chosen = *answer_.recommended;
        std::vector<AnswerLine> lines;
        lines.push_back(
            {"",
             chosen == baseline_
                 ? fmt::format("keep the baseline {}{}{}", row(chosen),
                               *rows_[chosen].error < exact_below ? ": exact, nothing that shows is out of order" : "", note())
                 : "use " + row(chosen)});
        const bool is_of_time = asked_.cost == &Standing::time;
        if (!answer_.as_cheap.empty()) lines.push_back({is_of_time ? "as fast within the spread" : "as small", as_cheap()});
        if (!answer_.unsteady.empty())
            lines.push_back({"", fmt::format("{} more may be as fast: the spread of their times is above {:g} %",
                                             answer_.unsteady.size(), 100 * largest_spread)});
        if (answer_.most_accurate != chosen) lines.push_back({"most accurate", row(*answer_.most_accurate)});
        if (answer_.cheaper) {
            const Standing& cheaper = rows_[*answer_.cheaper];
            lines.push_back(
                {"cheaper", row(*answer_.cheaper) + (keeps_all(cheaper, asked_) ? "" : " misses " + missed(cheaper, asked_))});
        }
        return lines;
    }

    std::string as_cheap() const {
        std::vector<std::string> rows;
        rows.reserve(answer_.as_cheap.size());
        for (const std::size_t i : answer_.as_cheap) rows.push_back(row(i));
        return first_of(rows);
    }

    std::vector<AnswerLine> nearest() const {
        constexpr std::array all_of{"it", "both", "all"};
        const std::string none = fmt::format("no technique{} keeps {}", asked_.gpu.empty() ? "" : " with a modeled time",
                                             all_of[std::size_t(limited(asked_)) - 1]);
        if (!answer_.nearest) return {{"", none}};
        const std::size_t near = *answer_.nearest;
        return {{"", fmt::format("{}; the nearest, {}, misses {}", none, row(near), missed(rows_[near], asked_))}};
    }

    std::span<const Standing> rows_;
    std::optional<std::size_t> baseline_;
    const Question& asked_;
    const AnswerNames& names_;
    Answer answer_;
};

}  // namespace

Answer find_answer(std::span<const Standing> rows, std::optional<std::size_t> baseline, const Question& asked) {
    const auto cost = [&](const Standing& row) { return row.*asked.cost; };
    const auto error = [&](const Standing& row) { return std::pair(row.compared_error(), cost(row)); };
    const auto keeps = [&](const Standing& row) { return keeps_all(row, asked); };
    const auto is_unsteady = [&](const Standing& row) {
        return asked.cost == &Standing::time && row.spread > largest_spread * row.time;
    };
    Answer answer{.most_accurate = least(rows, keeps, error)};
    if (!answer.most_accurate) {
        answer.nearest = least(
            rows, [](const Standing& row) { return row.error.has_value(); },
            [&](const Standing& row) { return excess(row, asked); });
        return answer;
    }
    answer.as_accurate = std::size_t(std::ranges::count_if(rows, [&](const Standing& row) {
        return keeps(row) && row.compared_error() == rows[*answer.most_accurate].compared_error();
    }));
    const bool suffices = baseline && asked.error && keeps(rows[*baseline]);
    const Standing& cheapest = rows[*least(rows, keeps, cost)];
    const auto is_level = [&](const Standing& row) {
        return keeps(row) && cost_the_same(row, cheapest, asked.cost) && !is_unsteady(row);
    };
    answer.recommended = suffices ? baseline : asked.error ? least(rows, is_level, error) : answer.most_accurate;
    if (!answer.recommended) answer.recommended = least(rows, keeps, cost);
    const Standing& chosen = rows[*answer.recommended];
    answer.cheaper = least(
        rows,
        [&](const Standing& row) { return row.error && cost(row) < cost(chosen) && !cost_the_same(row, chosen, asked.cost); },
        error);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i == *answer.recommended || !keeps(rows[i]) || !cost_the_same(rows[i], chosen, asked.cost)) continue;
        (is_unsteady(rows[i]) ? answer.unsteady : answer.as_cheap).push_back(i);
    }
    std::ranges::stable_sort(answer.as_cheap, {}, [&](std::size_t i) { return error(rows[i]); });
    return answer;
}

std::vector<AnswerLine> answer_lines(std::span<const Standing> rows, std::optional<std::size_t> baseline, const Question& asked,
                                     const AnswerNames& names) {
    if (asked.within && names.unit.empty()) return {{"answer", "none; the baseline's time could not be measured"}};
    return AnswerLines(rows, baseline, asked, names).lines();
}

std::string most_accurate_text(const Answer& answer, const std::string& row, std::size_t rows, std::string_view over,
                               bool is_timed) {
    const bool is_alone = answer.as_accurate <= 1;
    const std::string first =
        is_alone ? "the" : fmt::format("{} of the {}", is_timed ? "the fastest" : "one", answer.as_accurate);
    return fmt::format("{} is {} most accurate of {}{}", row, first, plural(rows, "row"), over);
}

std::string as_text(std::span<const AnswerLine> lines) {
    std::string text;
    for (const AnswerLine& line : lines) text += fmt::format("{}{}{}\n", line.head, line.head.empty() ? "" : ": ", line.text);
    return text;
}

}  // namespace strata
