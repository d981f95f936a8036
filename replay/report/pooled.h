// Reports of several frames and captures as one: how techniques fare in the worst frame of a capture, in the mean over captures.
// No device.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "replay/report/report.h"

namespace strata {

/// A technique with its settings over all frames that need the stage. Of the frames of a capture the worst decides: the camera
/// comes by there. Over captures errors that are shares of white, of one scale on all frames, have their mean; what else has a
/// scale of its own on each frame has its geometric mean: half on one and twice on another cancel.
struct PooledRow {
    std::string technique, settings;
    double error = 0;
    std::optional<double> rms_error = {};  ///< over all pixels that the stage changes, of shares of white
    double worst_error = 0;                ///< of a frame
    std::size_t worst_report = 0;          ///< its place among the reports
    std::string worst_frame;               ///< "a.strata", or "a.strata frame 3" where a capture has several
    std::optional<double> time;            ///< in the time unit, geometric mean; none where a frame has none
    double time_spread = 0;                ///< of that, from those of the frames
    double bytes_per_pixel = 0;            ///< arithmetic mean: it may be 0
    std::optional<double> flicker;         ///< geometric mean
    std::size_t frames = 0;                ///< that it can do; only rows that can do all of them are ranked
    bool has_other_truth = false;          ///< in any of them: not ranked, see Measurement
    bool on_front = false, on_memory_front = false;
    Standing asked = {};       ///< asked_standings() of the frames as one: limits in milliseconds and bytes are of the worst
    std::string command = {};  ///< replays its worst frame; empty where nothing was asked
};

struct Pool {
    Stage stage = Stage::transparency;
    std::size_t captures = 0, frames = 0;  ///< whose frames need the stage and are changed by it
    std::vector<std::string> left_out;     ///< frames of which too few pixels change, or whose errors are not of the picture
    RankingError error;                    ///< what PooledRow::error is of
    std::string time_unit;                 ///< as in Report; empty when not all have the same
    Question question;                     ///< of the reports
    std::string times_are;                 ///< of AnswerNames
    std::string without_modeled_time;      ///< of a frame that has some
    std::vector<PooledRow> rows;           ///< those that can do all frames first, then the ranked ones, then the most accurate
};

/// Of reports on one stage.
Pool pooled(std::span<const Report>);

/// exp of the mean of the logs. Values below 1e-5 count as 1e-5, which nobody sees: one frame that a technique happens to do
/// exactly would be all of its mean, and the rounding of an exact technique is no merit.
double geometric_mean(std::span<const double>);

/// "a.strata frame 3" for each, or without the frame where a capture has one.
std::vector<std::string> frame_names(std::span<const Report>);

/// Whether the row can do all frames, and none by another truth.
bool is_ranked(const Pool&, const PooledRow&);
/// Rows that are not ranked have no error.
std::vector<Standing> standings(const Pool&);
/// The row whose time is 1, if it can do all frames.
std::optional<std::size_t> baseline_of(const Pool&);

/// "3 captures", "4 frames", "6 frames of 2 captures".
std::string frames_text(const Pool&);

/// To the question of the reports, over all of their frames.
Answer answer_of(const Pool&);
/// The answer in words; none where nothing was asked.
std::vector<AnswerLine> answer_lines(const Pool&);
/// Whether limits were asked for that no row keeps.
bool is_unanswered(const Pool&);

std::string as_text(const Pool&);
/// The reports and what they are pooled to.
std::string as_json(std::span<const Report>, const Pool&);
std::string as_csv(std::span<const Report>, const Pool&);

}  // namespace strata
