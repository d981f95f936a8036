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

bool keeps_error(const Standing& row, const Question& asked) { return row.error && (!asked.error || *row.error <= *asked.error); }

bool keeps_time(const Standing& row, const Question& asked) {
    return row.error && (!asked.within || row.time + row.spread <= *asked.within);
}

/// The first row with the least value of those that are candidates.
template <typename Keeps, typename Value>
std::optional<std::size_t> least(std::span<const Standing> rows, std::optional<std::size_t> baseline, const Keeps& keeps,
                                 const Value& value) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (i != baseline && keeps(rows[i]) && (!best || value(rows[i]) < value(rows[*best]))) best = i;
    return best;
}

std::string metrics(const Standing& row, const AnswerNames& names) {
    const std::string error = fmt::format("{} {}", names.error.name, names.error.text(*row.error));
    return names.unit.empty() ? error : fmt::format("{}, {:.2f}x", error, row.time);
}

std::string limits(const Question& asked, const AnswerNames& names) {
    std::string text;
    if (asked.error) text += fmt::format("{} up to {}", names.error.name, names.error.text(*asked.error));
    if (asked.within) text += fmt::format("{}within {}x of {}", asked.error ? " " : "", short_number(*asked.within), names.unit);
    return text;
}

}  // namespace

Answer find_answer(std::span<const Standing> rows, std::optional<std::size_t> baseline, const Question& asked) {
    const auto time = [](const Standing& row) { return row.time; };
    const auto error = [](const Standing& row) { return *row.error; };
    const auto both = [&](const Standing& row) { return keeps_error(row, asked) && keeps_time(row, asked); };
    Answer answer;
    answer.keeps_all = least(rows, baseline, both, time).has_value();
    const auto by_error = [&](const Standing& row) { return answer.keeps_all ? both(row) : keeps_error(row, asked); };
    const auto by_time = [&](const Standing& row) { return answer.keeps_all ? both(row) : keeps_time(row, asked); };
    if (asked.error) answer.cheapest = least(rows, baseline, by_error, time);
    if (asked.within) answer.most_accurate = least(rows, baseline, by_time, error);
    for (std::size_t i = 0; answer.cheapest && i < rows.size(); ++i) {
        const Standing& best = rows[*answer.cheapest];
        const bool is_apart = rows[i].time - best.time > rows[i].spread + best.spread;
        if (i == *answer.cheapest || i == baseline || !by_error(rows[i]) || is_apart) continue;
        (rows[i].spread > largest_spread * rows[i].time ? answer.unsteady : answer.as_fast).push_back(i);
    }
    return answer;
}

std::string answer_text(std::span<const Standing> rows, std::optional<std::size_t> baseline, const Question& asked,
                        const AnswerNames& names) {
    if (asked.within && names.unit.empty()) return "answer: none; the baseline's time could not be measured\n";
    const Answer answer = find_answer(rows, baseline, asked);
    const auto row = [&](std::size_t i) { return fmt::format("{} ({})", names.rows[i], metrics(rows[i], names)); };
    std::string text = fmt::format("answer for {}: ", limits(asked, names));
    if (asked.error && asked.within && !answer.keeps_all) text += "no technique; ";
    if (asked.error)
        text += answer.cheapest ? fmt::format("cheapest {}", row(*answer.cheapest)) : "no technique has so small an error";
    for (std::size_t i = 0; i < answer.as_fast.size(); ++i)
        text += fmt::format("{}{}", i == 0 ? ", as fast within the spread " : ", ", names.rows[answer.as_fast[i]]);
    if (!answer.unsteady.empty())
        text += fmt::format(" ({} more may be: the spread of their times is above {:g} %)", answer.unsteady.size(),
                            100 * largest_spread);
    if (asked.error && asked.within) text += "; ";
    if (asked.within)
        text += answer.most_accurate ? fmt::format("most accurate {}", row(*answer.most_accurate)) : "no technique is so fast";
    text += "\n";
    if (baseline && rows[*baseline].error)
        text += fmt::format("the baseline {} is not an answer; here it has {}{}{}{}\n", names.rows[*baseline],
                            metrics(rows[*baseline], names),
                            *rows[*baseline].error < exact_below ? ": exact, nothing that shows is out of order" : "",
                            names.baseline_note.empty() ? "" : "; ", names.baseline_note);
    return text;
}

}  // namespace strata
