// The answer to "which technique has less than 1 % error within 2x of the baseline's time?" No device.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "replay/report/ranking.h"

namespace strata {

/// What a row has to keep; without both there is no question.
struct Question {
    std::optional<double> error;   ///< largest error, a share: .01
    std::optional<double> within;  ///< largest time in units of the baseline's
    bool is_asked() const { return error || within; }
};

/// Rows by index. The baseline takes part: who has it and is served by it needs no other technique.
struct Answer {
    /// Keeps all that is asked: the baseline if it keeps an error that is asked, else the fastest such row; where only a time is
    /// asked, the most accurate.
    std::optional<std::size_t> recommended;
    std::optional<std::size_t> most_accurate;  ///< of the rows that keep all
    std::optional<std::size_t> cheaper;        ///< the most accurate of those that are faster than the recommended one
    std::optional<std::size_t> nearest;        ///< where no row keeps all: exceeds the limits by the least factor
    std::vector<std::size_t> as_fast;          ///< keep all and are as fast as the recommended row within their spreads, by error
    std::vector<std::size_t> unsteady;  ///< of those, such as have a spread above a quarter of their time: they say nothing
};
Answer find_answer(std::span<const Standing>, std::optional<std::size_t> baseline, const Question&);

/// What a sentence needs to know of the rows.
struct AnswerNames {
    std::vector<std::string> rows;
    RankingError error;
    std::string unit;                        ///< "alpha_blend"; empty: no time could be measured in units of it
    std::string baseline_note = {};          ///< what its time contains, or nothing
    std::vector<std::string> commands = {};  ///< by row: what replays it; or none
};

/// The head of the line with the command.
inline constexpr std::string_view replay_head = "to replay it";

/// "cheaper: a_buffer (...) misses both limits".
struct AnswerLine {
    std::string head, text;  ///< without a head: a sentence
};
std::vector<AnswerLine> answer_lines(std::span<const Standing>, std::optional<std::size_t> baseline, const Question&,
                                     const AnswerNames&);
/// Those lines below each other.
std::string answer_text(std::span<const Standing>, std::optional<std::size_t> baseline, const Question&, const AnswerNames&);
std::string as_text(std::span<const AnswerLine>);

}  // namespace strata
