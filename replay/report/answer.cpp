#include "replay/report/answer.h"

#include <algorithm>

#include <fmt/format.h>

#include "replay/tables/table.h"

namespace strata {
namespace {

// What rounding in float leaves of an exact blend.
constexpr double exact_below = 1e-4;
// A time with a larger spread, as a share of it, is told apart from hardly any other: a busy machine, or too few repeats.
constexpr double largest_spread = .25;
// Rows as fast as the recommended one.
constexpr std::size_t most_named = 3;

bool keeps_error(const Standing& row, const Question& asked) { return row.error && (!asked.error || *row.error <= *asked.error); }

bool keeps_time(const Standing& row, const Question& asked) {
    return row.error && (!asked.within || row.time + row.spread <= *asked.within);
}

bool keeps_all(const Standing& row, const Question& asked) { return keeps_error(row, asked) && keeps_time(row, asked); }

/// The factor by which a ranked row exceeds the limit that it exceeds most.
double excess(const Standing& row, const Question& asked) {
    const double error = asked.error ? *row.error / *asked.error : 0;
    return std::max(error, asked.within ? (row.time + row.spread) / *asked.within : 0);
}

/// The first row with the least value of those that are candidates.
template <typename Keeps, typename Value>
std::optional<std::size_t> least(std::span<const Standing> rows, const Keeps& keeps, const Value& value) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (keeps(rows[i]) && (!best || value(rows[i]) < value(rows[*best]))) best = i;
    return best;
}

std::string metrics(const Standing& row, const AnswerNames& names) {
    const std::string error = fmt::format("{} {}", names.error.name, names.error.text(*row.error));
    const std::string time = names.unit.empty() ? "" : fmt::format(", {:.2f}x", row.time);
    return fmt::format("{}{}, {} bytes per pixel", error, time, row.bytes_per_pixel);
}

std::string limits(const Question& asked, const AnswerNames& names) {
    std::string text;
    if (asked.error) text += fmt::format("{} up to {}", names.error.name, names.error.text(*asked.error));
    if (asked.within) text += fmt::format("{}within {}x of {}", asked.error ? " " : "", short_number(*asked.within), names.unit);
    return text;
}

/// The limits that a row does not keep: "the limit of error", "both limits".
std::string missed(const Standing& row, const Question& asked) {
    const bool error = !keeps_error(row, asked), time = !keeps_time(row, asked);
    return error && time ? "both limits" : error ? "the limit of error" : "the limit of time";
}

/// Lines of an answer, each a sentence about a row.
class AnswerLines {
public:
    AnswerLines(std::span<const Standing> rows, std::optional<std::size_t> baseline, const Question& asked,
                const AnswerNames& names)
        : rows_(rows), baseline_(baseline), asked_(asked), names_(names), answer_(find_answer(rows, baseline, asked)) {}

    std::vector<AnswerLine> lines() const {
        std::vector<AnswerLine> lines = answer_.recommended ? recommendation() : nearest();
        lines.front().head = "answer for " + limits(asked_, names_);
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
    std::string row(std::size_t i) const { return fmt::format("{} ({})", names_.rows[i], metrics(rows_[i], names_)); }
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
        if (!answer_.as_fast.empty()) lines.push_back({"as fast within the spread", as_fast()});
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

    std::string as_fast() const {
        std::string text;
        for (std::size_t i = 0; i < std::min(answer_.as_fast.size(), most_named); ++i)
            text += (i == 0 ? "" : ", ") + row(answer_.as_fast[i]);
        if (answer_.as_fast.size() > most_named) text += fmt::format(" and {} more", answer_.as_fast.size() - most_named);
        return text;
    }

    std::vector<AnswerLine> nearest() const {
        const std::string none = asked_.error && asked_.within ? "no technique keeps both" : "no technique keeps it";
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
    const auto time = [](const Standing& row) { return row.time; };
    const auto error = [](const Standing& row) { return *row.error; };
    const auto keeps = [&](const Standing& row) { return keeps_all(row, asked); };
    Answer answer{.most_accurate = least(rows, keeps, error)};
    if (!answer.most_accurate) {
        answer.nearest = least(
            rows, [](const Standing& row) { return row.error.has_value(); },
            [&](const Standing& row) { return excess(row, asked); });
        return answer;
    }
    const bool suffices = baseline && asked.error && keeps(rows[*baseline]);
    answer.recommended = suffices ? baseline : asked.error ? least(rows, keeps, time) : answer.most_accurate;
    const Standing& chosen = rows[*answer.recommended];
    answer.cheaper = least(
        rows, [&](const Standing& row) { return row.error && row.time < chosen.time && !are_level(row, chosen); }, error);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i == *answer.recommended || !keeps(rows[i]) || !are_level(rows[i], chosen)) continue;
        (rows[i].spread > largest_spread * rows[i].time ? answer.unsteady : answer.as_fast).push_back(i);
    }
    std::ranges::stable_sort(answer.as_fast, {}, [&](std::size_t i) { return error(rows[i]); });
    return answer;
}

std::vector<AnswerLine> answer_lines(std::span<const Standing> rows, std::optional<std::size_t> baseline, const Question& asked,
                                     const AnswerNames& names) {
    if (asked.within && names.unit.empty()) return {{"answer", "none; the baseline's time could not be measured"}};
    return AnswerLines(rows, baseline, asked, names).lines();
}

std::string answer_text(std::span<const Standing> rows, std::optional<std::size_t> baseline, const Question& asked,
                        const AnswerNames& names) {
    return as_text(answer_lines(rows, baseline, asked, names));
}

std::string as_text(std::span<const AnswerLine> lines) {
    std::string text;
    for (const AnswerLine& line : lines) text += fmt::format("{}{}{}\n", line.head, line.head.empty() ? "" : ": ", line.text);
    return text;
}

}  // namespace strata
