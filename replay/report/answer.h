// The answer to "which technique has less than 1 % error within 2x of the baseline's time?" No device.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "replay/report/ranking.h"

namespace strata {

/// What a row has to keep; without both there is no question.
struct Question {
    std::optional<double> error;   ///< largest error, a share: .01
    std::optional<double> within;  ///< largest time in units of the baseline's
    bool is_asked() const { return error || within; }
};

/// Rows by index: those that keep all that is asked; where no row does, those that keep each limit alone. The baseline is not an
/// answer.
struct Answer {
    bool keeps_all = false;
    std::optional<std::size_t> cheapest;       ///< the fastest that keeps the error
    std::optional<std::size_t> most_accurate;  ///< that keeps the time
    std::vector<std::size_t> as_fast;          ///< that keep the error and are as fast as the cheapest within their spreads
    std::vector<std::size_t> unsteady;  ///< of those, such as have a spread above a quarter of their time: they say nothing
};
Answer find_answer(std::span<const Standing>, std::optional<std::size_t> baseline, const Question&);

/// What a sentence needs to know of the rows.
struct AnswerNames {
    std::vector<std::string> rows;
    RankingError error;
    std::string unit;                ///< "alpha_blend"; empty: no time could be measured in units of it
    std::string baseline_note = {};  ///< what its time contains, or nothing
};
std::string answer_text(std::span<const Standing>, std::optional<std::size_t> baseline, const Question&, const AnswerNames&);

}  // namespace strata
