// The answer to "which technique has less than 1 % error within 2x of the baseline's time, or 2 ms, and 64 MiB?" No device.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "replay/report/ranking.h"

namespace strata {

/// Limits that a row has to keep; without any there is no question.
struct Question {
    std::optional<double> error;      ///< largest error, a share: .01
    std::optional<double> within;     ///< largest time in units of the baseline's
    std::optional<double> within_ms;  ///< largest time in milliseconds
    std::optional<double> memory;     ///< most bytes of the stage
    Cost cost = &Standing::time;      ///< what the recommended row has least of
    std::string gpu = {};             ///< times are modeled ones of this GPU (find_gpu_model()); empty: measured
    bool is_asked() const { return error || within || within_ms || memory; }
};

/// Rows by index. The baseline takes part: who has it and is served by it needs no other technique.
struct Answer {
    /// Keeps all that is asked: the baseline if it keeps an error that is asked, else the cheapest such row, or the most accurate
    /// of those whose spreads do not tell them from it; where no error is asked, the most accurate.
    std::optional<std::size_t> recommended;
    std::optional<std::size_t> most_accurate;  ///< of the rows that keep all; of equally accurate ones the cheapest
    std::size_t as_accurate = 0;               ///< how many of these are as accurate as it, itself among them
    std::optional<std::size_t> cheaper;        ///< the most accurate of those that are cheaper than the recommended one
    std::optional<std::size_t> nearest;        ///< where no row keeps all: exceeds the limits by the least factor
    std::vector<std::size_t> as_cheap;         ///< keep all and cost as much as the recommended row, within spreads, by error
    std::vector<std::size_t> unsteady;  ///< of those, such as have a spread above a quarter of their time: they say nothing
};
Answer find_answer(std::span<const Standing>, std::optional<std::size_t> baseline, const Question&);

/// True where times are multiples of the baseline's: modeled ones need that of the baseline.
inline bool has_time_unit(const Question& asked, std::span<const Standing> rows, std::optional<std::size_t> baseline) {
    return asked.gpu.empty() || (baseline && rows[*baseline].error);
}

/// What a sentence needs to know of the rows.
struct AnswerNames {
    std::vector<std::string> rows;
    RankingError error;
    std::string unit;                        ///< "alpha_blend"; empty: no time is known in units of it
    std::string baseline_note = {};          ///< what its time contains, or nothing
    std::string times_are = {};              ///< whose they are, as a sentence; or nothing
    std::string without_time = {};           ///< rows that have none on the GPU that is asked for, and why; or nothing
    std::string over = {};                   ///< " over 3 captures", where errors are of several frames
    std::vector<std::string> worst = {};     ///< by row, behind its error: "in the mean, 17 % on b.strata"; or none
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
/// Where nothing was asked: "a is the most accurate of 14 rows", "a is the fastest of the 3 most accurate of 14 rows over 2
/// captures".
std::string most_accurate_text(const Answer&, const std::string& row, std::size_t rows, std::string_view over, bool is_timed);
/// The lines below each other.
std::string as_text(std::span<const AnswerLine>);

}  // namespace strata
