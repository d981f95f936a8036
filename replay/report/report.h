// Every technique of a stage, at its defaults and at other settings, on one frame: error against the truth beside time, memory,
// flicker and counters, and what is on the Pareto fronts.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "passes/reference/standard_error.h"
#include "passes/tolerance.h"
#include "replay/report/answer.h"
#include "replay/report/ranking.h"
#include "replay/session/session.h"

namespace strata {

/// "--sweep key=a,b,c": every technique of the stage that has the key is measured at each value.
struct Sweep {
    std::string key;
    std::vector<std::string> values;
};

/// The eye walks ahead and turns its head, both evenly: what moves so little should not flicker. Walking takes surfaces through a
/// technique's slices of depth; but the order of view depths, which object sorting goes by, changes by turning only.
struct Walk {
    std::uint32_t frames = 64;
    std::optional<double> dolly;  ///< meters from the first frame to the last; none: default_dolly()
    double pan = 5;               ///< degrees to the right from the first frame to the last
};

struct Measurement;

/// Of rows with Measurement::has_other_truth.
inline constexpr std::string_view other_truth_note = "measured against another truth, so it is not ranked";

/// What errors are of: the stage's first output, or the picture that later stages make of it.
enum class ErrorAt { stage, picture };

/// The error that ranks rows where their stage has it: that of radiance as a display shows it, or that of radiance itself, which
/// the brightest sample decides.
enum class RankedBy { display_rmse, relative_rmse };

struct ReportRequest {
    Request base;  ///< frame, other stages' choices
    /// None: of the stage where it makes radiance or the picture itself, else of the picture if the truth can take its place
    /// there.
    std::optional<ErrorAt> error_at;
    RankedBy ranked_by = RankedBy::display_rmse;
    Stage stage = Stage::transparency;
    std::vector<std::string> techniques;  ///< "technique key=value ..."; none: every technique of the stage
    bool defaults_only = false;           ///< without the techniques' own variants
    std::vector<Sweep> sweeps;            ///< instead of their own variants
    Question question;
    std::size_t repeats = 7;
    /// Above 0 and below `repeats`: rows are timed so often, once where another is twice as good, and `repeats` times where their
    /// place is uncertain (enough_repeats.h).
    std::size_t least_repeats = 0;
    std::optional<Walk> flicker;
    bool wants_pictures = false;  ///< Report::truth_picture and Measurement::picture
    /// Told of each row as soon as its errors and times are known: the row, its place from 1 on, and of how many.
    std::function<void(const Measurement&, std::size_t, std::size_t)> on_row = {};
};

/// A row as a display shows it.
struct RowPicture {
    std::vector<std::byte> png;              ///< RGBA; what shows as the truth does is transparent
    std::uint32_t worst_x = 0, worst_y = 0;  ///< of those that rounding does not decide, the pixel that is furthest from the
                                             ///< truth's, as sRGB encodes both
    double worst_off = 0;                    ///< by so much, a distance of colors; 0: no pixel differs
    std::vector<std::byte> flip_png;         ///< FLIP's map in colors of magma(): RGB; empty where a page does not show it
    std::string probe_svg;                   ///< the worst pixel's fragments and T(z) (probe.h); empty where there are none
};

/// A step of a technique, or what the host does before its steps.
struct StepTime {
    std::string name;  ///< StepRecord::name, or "sort on the CPU"
    Spread ms;
};

/// On a GPU that need not be there: modeled_cost.h.
struct ModeledCost {
    std::optional<double> kilocycles = {}, ms = {};  ///< of the whole GPU
    std::string missing = {};                        ///< why there are none
};

/// One row.
struct Measurement {
    std::string technique, settings;  ///< settings: "falloff=20 weight=w9", only what differs from the defaults
    std::string truth = {};           ///< ReportTruth::name
    /// Than the report's first row, the time unit's: it answers another question, often an easier one, and is not ranked.
    bool has_other_truth = false;
    RankedBy ranked_by = RankedBy::display_rmse;
    Accuracy accuracy;
    double tolerance = 0;               ///< of the technique, for accuracy.model_rmse
    double tolerated_worst = HUGE_VAL;  ///< and for accuracy.model_worst
    ModelKind model_is = ModelKind::paper;
    Spread stage_ms, frame_ms;
    std::optional<Spread> time;               ///< stage_ms as multiples of the time unit's, repeat by repeat
    std::vector<StepTime> steps;              ///< of stage_ms, in the order of the frame
    std::vector<double> repeats_ms;           ///< the stage's times, in the order of the repeats
    std::vector<double> baseline_repeats_ms;  ///< the time unit's in the same repeats; empty where there is no `time`
    std::optional<Spread> sort_ms;            ///< of stage_ms: what the host sorts in every frame
    std::optional<Spread> unchanged_ms;       ///< of the stage in a frame that follows itself (Abilities::keeps_work)
    std::uint64_t stage_bytes = 0;
    double bytes_per_pixel = 0;
    std::optional<std::uint64_t> invocations;  ///< of fragment and compute shaders, where the device counts them
    std::optional<double> flicker;
    std::optional<double> coverage_flicker;  ///< of stage gbuffer on frames with masked surfaces: CoverageFlicker::mean()
    std::vector<CounterRecord> counters;     ///< of the technique
    bool on_front = false;                   ///< nothing is both more accurate and faster
    bool is_tied = false;                    ///< the spreads alone keep it off the front: see ties_in_time()
    bool on_memory_front = false;            ///< nothing is both more accurate and smaller
    std::optional<ModeledCost> modeled;      ///< where the question names a GPU
    std::optional<RowPicture> picture;       ///< ReportRequest::wants_pictures

    /// Whether it has errors: it is supported, and a sample of it could be judged.
    bool is_measured() const { return !accuracy.technique_errors.empty(); }
};

/// What rows are measured against.
struct ReportTruth {
    std::string name = {};                        ///< as TruthRow has it; empty: the stage's truth
    std::string is;                               ///< for people: TruthRow::is, or which technique stood in and how exact it is
    std::optional<StandardError> own_error = {};  ///< of a truth that is an estimate by random numbers
};

struct Report {
    Stage stage = Stage::transparency;
    std::string capture_name;  ///< for people; the caller's
    std::string capture_id;
    std::string date = {};            ///< when it was made, utc_date(); the caller's
    std::vector<ReportTruth> truths;  ///< of its rows; the first is that of the first row
    ErrorAt error_at = ErrorAt::stage;
    std::string no_picture = {};         ///< why errors are of the stage although the default is the picture; else empty
    Request base = {};                   ///< ReportRequest::base
    std::size_t frame = 0, repeats = 0;  ///< of the row with the most; each has its own in its spreads
    std::size_t least_repeats = 0;       ///< of the row with the fewest
    std::uint32_t width = 0, height = 0, samples = 1;
    DeviceInfo device;
    std::string time_unit;        ///< the technique whose time is 1; empty: none could be measured
    std::optional<Walk> flicker;  ///< with its dolly
    Question question;
    std::vector<Measurement> rows;         ///< most accurate first, then those with another truth, then what is not supported
    std::string skipped;                   ///< why the frame does not need the stage; then there are no rows
    std::string stopped;                   ///< what is missing because a stop was asked for: "stopped after 16 of 97 rows"
    bool is_timed = true;                  ///< false: stopped before any time was measured
    std::vector<std::byte> truth_picture;  ///< PNG; empty: none was asked for, or none can be made
    std::size_t sorted_objects = 0, sorted_particles = 0;  ///< of the frame, by techniques with Abilities::sorts_objects
};

/// Stopped (Session::stop_when), it gives what is known by then, or fails where no row is.
Result<Report> make_report(Session&, const ReportRequest&, const Progress& = {});

/// Marks the rows that no other row beats in both error and time, and in both error and memory.
void mark_fronts(std::vector<Measurement>&);
/// The figure by which a supported row is ranked and pooled: that of Measurement::ranked_by, else relative rmse, else the first
/// of its judge. Frames differ in how much of them the stage changes, so it is over what the stage changes, where that is known.
const Metric& ranking_metric(const Measurement&);
/// Its name says whether it is over what the stage touches alone.
RankingError ranking_error(const Measurement&);
/// The rows by their ranking figures; time in the time unit, or in milliseconds without one. Rows that are not ranked have no
/// error.
std::vector<Standing> standings(std::span<const Measurement>);
/// The rows as the report's question sees them: where it names a GPU, with the times modeled for that, and without errors where
/// there are none.
std::vector<Standing> asked_standings(const Report&);
/// The row whose time is 1, if it was measured.
std::optional<std::size_t> baseline_of(const Report&);

/// The request of a row of a report that started from a base.
Request request_of(const Measurement&, Request base);

/// To its question; empty where the stage changes too few pixels.
Answer answer_of(const Report&);

/// The device whose times an answer rests on, as a sentence; nothing where it rests on none.
std::string times_text(const Report&);
/// Report::no_picture as a sentence; empty where there is none.
std::string no_picture_text(const Report&);
/// The rows that the GPU of the question has no time for, and why; empty where there are none.
std::string without_modeled_time(const Report&);
/// The answer in words; none where nothing was asked.
std::vector<AnswerLine> answer_lines(const Report&);
/// The command that replays a row.
std::string command_of(const Report&, const Measurement&);

/// Whether limits were asked for that no row keeps, or of too little of a picture.
bool is_unanswered(const Report&);

/// The figures of the stage's judge, and FLIP's mean behind them where there is one.
std::vector<Metric> errors_of(const Measurement&);

/// What is wrong with a technique's implementation, as a sentence without its subject: "is 2e-02 from its own model, ..."; empty
/// where it is within its tolerance.
std::string implementation_doubt(const Measurement&);

/// Whether the model could not decide a single texel: an implementation error of 0 then says nothing.
bool is_nothing_compared(const Measurement&);

/// Sentences about the light that a row's images could not hold, separated by "; ".
std::string light_faults(const Measurement&);

/// The document of one report as JSON.
inline constexpr std::string_view report_schema = "strata.report", pooled_reports_schema = "strata.reports";
inline constexpr int report_schema_version = 1;

std::string as_text(const Report&);
std::string as_json(const Report&);
std::string as_csv(const Report&);

}  // namespace strata
