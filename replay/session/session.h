// Open a capture on a device, choose techniques, run, read back, peek, judge: the one API of CLI, inspector and tests.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "capture_format/frame_features.h"
#include "capture_format/partial.h"
#include "capture_format/result.h"
#include "passes/debug_views.h"
#include "passes/graph/plan.h"
#include "passes/metric.h"
#include "replay/gpu/device.h"
#include "replay/images/draw_cover.h"
#include "replay/images/host_image.h"
#include "replay/measure/timing.h"
#include "replay/session/choices.h"
#include "replay/session/counter_record.h"
#include "replay/session/frame_variant.h"
#include "replay/session/light_check.h"
#include "replay/session/memory_need.h"
#include "replay/session/skipped_stage.h"

namespace strata {

class Capture;        // capture_format/reader.h
class FragmentLists;  // passes/reference/fragments.h
struct Frame;         // capture_format/frame.h

/// Whether a run brings back what every pass gave (Run::passes). Then every pass is executed, whatever the memo holds.
enum class Passes { not_read, read_back };
/// Whether a run looks for light that it could not hold (Run::light_faults). Images of light are read back for it, but not under
/// a memory budget.
enum class LightCheck { off, on };

/// What to replay and what to bring back.
struct Request {
    FrameVariant variant;
    ChoiceChanges choices = {};  ///< against the recorded ones
    std::vector<std::string> outputs = {
        "display"};                    ///< names of frame_images.h, or "stage/technique:view" debug views and tables
    std::string until;                 ///< last step to run: part of its name; empty: all
    Passes passes = Passes::not_read;  ///< not with `until`
    LightCheck light = LightCheck::off;
    bool once = false;  ///< nothing is kept for later runs that share stages with this one
    /// Timed as a frame that follows itself: what need not be done again is not. Else as if nothing came before it.
    bool unchanged = false;
    bool whole = false;    ///< timed as a whole, too (Run::whole_frame_ms): as many more runs
    bool counted = false;  ///< timed, and run once more to count how often shaders run (Run::stage_invocations)
    friend bool operator==(const Request&, const Request&) = default;
};

struct StepRecord {
    Scope scope;
    std::string name;                       ///< the shader
    std::optional<Spread> ms;               ///< with timing
    std::vector<double> ms_by_repeat = {};  ///< what ms is the spread of, in turn
};

/// Called with what is being done and the share that is done, 0..1.
using Progress = std::function<void(std::string_view what, double done)>;

/// What a run held, in bytes.
struct RunMemory {
    std::uint64_t scene = 0, memo = 0, plan = 0;      ///< on the device when it was done
    std::uint64_t allocated = 0, peak_allocated = 0;  ///< taken from the device now, and the most since the session opened
    std::uint64_t host_peak = 0;                      ///< the process's, see host_peak_bytes()
    MemoryOverTime over_time;                         ///< by stage and step
};

/// Where a run spent the host's time, in milliseconds.
struct RunTimes {
    double load = 0, declare = 0, upload = 0;  ///< frame decoded and turned into records; graph compiled; scene to the device
    HostTimes device;
};

/// What one pass of a stage's technique gave: those of the stage's outputs (StageInfo::outputs) that it wrote, as it left them.
struct PassImages {
    Stage stage, at;     ///< whose technique, and where in the frame: combine's second pass stands at film
    std::string label;   ///< "transparency", or "combine at film"
    std::string choice;  ///< "technique key=value ..."
    std::map<std::string, HostImage> images;
};

/// A technique that ran on a frame which it says it cannot do.
struct UnsupportedChoice {
    std::string technique;
    std::string reason;  ///< "chromatic (material 'ruby' lets ...)": the feature and why the frame has it
};

/// What a DebugTable held.
struct NumberTable {
    std::vector<TableColumn> columns;
    std::vector<std::vector<double>> rows;
};

/// What one run gave.
struct Run {
    std::vector<StepRecord> steps;
    std::vector<SkippedStage> skipped;
    std::vector<CulledStep> culled;
    std::vector<CounterRecord> counters;
    std::set<std::string> not_counted;  ///< techniques: a step that counts was left out, because nothing asked for needs it
    std::vector<UnsupportedChoice> not_supported;
    std::map<std::string, HostImage> images;     ///< by the names asked for; names the frame does not have are absent
    std::map<std::string, NumberTable> tables;   ///< the debug tables among the names asked for
    std::map<std::string, std::string> choices;  ///< stage to "technique key=value ..."
    std::optional<Spread> frame_ms;              ///< with timing: sum of the steps
    std::map<std::string, Spread> stage_ms;      ///< with timing: sum of the steps of the stage's technique
    std::map<std::string, Spread>
        stage_sort_ms;  ///< of stage_ms: what the host sorts, of techniques with Abilities::sorts_objects
    // What they are the spreads of, in turn.
    std::vector<double> frame_ms_by_repeat;
    std::map<std::string, std::vector<double>> stage_ms_by_repeat, stage_sort_ms_by_repeat;
    /// Times of a frame that follows itself, where a technique keeps work (Request::unchanged): the frame's, and by stage.
    std::optional<Spread> unchanged_frame_ms;
    std::map<std::string, Spread> unchanged_stage_ms;
    std::map<std::string, std::uint64_t>
        stage_invocations;  ///< with Request::counted: how often its fragment and compute shaders ran
    std::uint32_t width = 0, height = 0, samples = 1;
    std::uint64_t image_bytes = 0, buffer_bytes = 0;
    std::map<std::string, std::uint64_t> stage_bytes;  ///< images and buffers first used by the stage's technique
    RunMemory memory;
    RunTimes host_ms;
    std::size_t passes_executed = 0, passes_from_memo = 0;
    std::size_t pipelines_created = 0;     ///< during this run
    std::vector<std::string> notes;        ///< what had to be reduced to fit the device; shaders that are not those built in
    std::vector<LightFault> light_faults;  ///< with LightCheck::on, by pass in the order of the frame
    std::vector<PassImages> passes;        ///< with Passes::read_back, in the order of the frame
    /// With timing: a step that does nothing takes this. So much of the time of every step, and of frame_ms as often as there are
    /// steps, is that of timestamps and barriers.
    std::optional<Spread> empty_step_ms;
    /// With timing and Request::whole: the frame between two timestamps, with nothing between its steps but their own barriers,
    /// so that they overlap where the device lets them. Without what the host sorts.
    std::optional<Spread> whole_frame_ms;
};

/// What a step of the plan wrote, read back right after it.
struct StepImages {
    std::size_t step = 0;  ///< its place in the plan
    Scope scope;
    std::string name;                         ///< as in StepRecord
    std::map<std::string, HostImage> images;  ///< by their names in the graph
};

/// A texel where result and model differ most, relative as in Tolerance.
struct WorstTexel {
    std::string image;
    std::uint32_t x = 0, y = 0, layer = 0;
    glm::dvec4 got{0}, wanted{0};
};

/// Ground that a row's errors stand on: little of a picture, or one sample of a frame, decides nothing about others.
struct Footing {
    std::size_t pixels = 0;      ///< that the stage changes and that are compared
    double clipped_share = 0;    ///< DisplayError::clipped_share
    double concentration = 0;    ///< DisplayError::concentration
    double brightest_share = 0;  ///< of the truth's energy over the samples that the stage changes: the brightest one's
    std::uint32_t x = 0, y = 0;  ///< of that sample
};

/// How a technique fared on a frame against its model (implementation error) and the stage's truth (technique error).
struct Accuracy {
    std::vector<Metric> technique_errors;  ///< from the stage's judge, or of the picture that later stages make
    std::vector<Metric> stage_errors;      ///< from the stage's judge, where technique_errors are of the picture
    std::optional<double> flip;            ///< mean of FLIP against the truth, of radiance or the picture
    std::vector<Metric> touched;           ///< the same over what the stage changes, or can change, of radiance or the picture
    double touched_share = 1;              ///< of all samples
    std::optional<Footing> footing;        ///< of errors over what is touched
    std::size_t not_numbers = 0;           ///< texels that are NaN in the result and in the truth: left out of these errors
    double undecided_share = 0;  ///< of samples: rounding decides their truth, their error is the distance to all it allows
    std::optional<Metric> undecided_bound;   ///< by how much the stage's error, so named, may be too small for it
    double unjudged_share = 0;               ///< of samples, from errors against the truth: what rounding allows is not known
    double model_rmse = 0, model_worst = 0;  ///< relative, see Tolerance
    std::size_t compared = 0, undecided = 0, trivial = 0;  ///< texels
    WorstTexel worst;
    std::vector<LightFault> light_faults;  ///< of the stage's outputs, and of the images it found
    std::string not_supported;             ///< why there is no answer, where the technique cannot do the frame
    std::string incomparable;  ///< why the result and its model or truth cannot be compared; those errors are infinite
};

/// What Session::reload_shaders did.
struct ReloadedShaders {
    std::vector<std::string> replaced;  ///< names of those that differ from the ones built in now
    std::size_t compiled = 0;           ///< the others of them were, by an earlier reload
};

/// What a result is compared with. The model of a frame of a million samples takes minutes, and who asks for the model alone
/// waits for no truth.
enum class Against { model_and_truth, model, truth };

class Session {
public:
    static Result<std::unique_ptr<Session>> open(const std::filesystem::path& capture, const DeviceChoice&,
                                                 Partial = Partial::refused);
    /// Frames made in code (tests, scenarios).
    static Result<std::unique_ptr<Session>> open(std::vector<Frame> frames, const DeviceChoice&);
    virtual ~Session() = default;

    virtual const DeviceInfo& device() const = 0;
    /// The capture it was opened on; null for frames made in code.
    virtual const Capture* capture() const = 0;
    std::string capture_id() const;
    virtual std::size_t frame_count() const = 0;
    virtual Result<Frame> frame(std::size_t) = 0;

    /// Runs once. Stage outputs that are still valid come from the memo.
    virtual Result<Run> run(const Request&) = 0;
    /// Runs a request in which a stage's outputs are these images instead of what its own pass gives; everything else is
    /// executed. Fails (usage) where later stages read more of that pass: buffers, or images that are missing here or not of its
    /// shape.
    virtual Result<Run> run_from(const Request&, Stage, const ImageSet& outputs) = 0;
    /// Runs the requests in turn, `repeats` times each, without the memo: medians with their spread. A turn before them warms up;
    /// it counts where it made no pipeline, as when every one of several requests was run before. Stopped (stop_when), it gives
    /// the repeats that were complete for all, or fails where there is none.
    virtual Result<std::vector<Run>> time(std::span<const Request>, std::size_t repeats, const Progress& = {}) = 0;
    /// The plan of a request, without running it.
    struct PlannedFrame {
        Plan plan;
        std::vector<SkippedStage> skipped;
        Features features;  ///< of the frame as the request has it
    };
    virtual Result<PlannedFrame> plan(const Request&) = 0;
    /// Any image after any step: step by index in the plan, image by its name in the graph.
    virtual Result<HostImage> peek(const Request&, std::size_t step, const std::string& image) = 0;
    /// What every stage gave, pass by pass in the order of the frame. Everything is executed; Request::outputs do not matter.
    Result<std::vector<PassImages>> pass_images(Request);
    /// What every step of a stage's passes wrote, in order, by the plan that keeps every image and so leaves nothing out.
    virtual Result<std::vector<StepImages>> step_images(const Request&, Stage) = 0;
    /// What a pixel is after every step that writes it, by the request's plan: images of one texel with all their layers and
    /// slices. Of images at lower resolution (tiles) the texel that covers the pixel; what does not lie on the screen, and what
    /// has several samples, is not among them (its layers are).
    virtual Result<std::vector<StepImages>> pixel_steps(const Request&, glm::uvec2 pixel) = 0;
    /// Which pixels show a draw of the frame (an emitter after the draws), row by row from the top: the draw in double, held
    /// against the depth the request's techniques leave.
    virtual Result<std::vector<Cover>> draw_cover(const Request&, std::uint32_t draw) = 0;
    /// Images that the stage's last pass writes, in double, before later stages draw over them, as they do in Request::outputs.
    virtual Result<ImageSet> stage_images(const Request&, Stage) = 0;
    /// The stage's truth on what the earlier stages gave, in double: seconds for a small frame.
    virtual Result<ImageSet> truth(const Request&, Stage) = 0;
    /// Runs the request's technique of a stage and compares with its model and with the stage's truth (computed unless given).
    virtual Result<Accuracy> judge(const Request&, Stage, Against = Against::model_and_truth,
                                   const ImageSet* truth = nullptr) = 0;

    /// The transparent fragments of every sample as the transparency stage found them, in double: seconds for a small frame,
    /// nothing when the frame and what made its depth are the same as the last time, unless time() in between
    /// dropped what limit_memo() has no room for. Valid until the next call.
    virtual Result<const FragmentLists*> transparent_fragments(const Request&) = 0;
    /// The same of one row of pixels; other rows may be empty. Executes no more than what leaves the opaque depth.
    virtual Result<const FragmentLists*> row_fragments(const Request& request, std::uint32_t /*y*/) {
        return transparent_fragments(request);
    }
    /// Runs a frame made in code instead of one of the capture's, on this device; Request::frame does not matter.
    virtual Result<std::vector<Run>> run(Frame, std::span<const Request>) = 0;

    /// Compiles the shaders that a folder (its passes/...) has other sources for than those built in, and uses them from here on;
    /// the rest are those built in. On failure, which says FILE:LINE of what is wrong, all stay as they were; so they do when one
    /// of the requests that are shown would have no plan with them. Stage outputs that depend on none of them stay valid.
    virtual Result<ReloadedShaders> reload_shaders(const std::filesystem::path& folder, std::span<const Request> shown = {}) = 0;

    /// Once a stop is requested, from any thread, every call fails with Fault::stopped before the next thing it would do: load a
    /// frame, compile a pipeline, submit to the device, compute a truth, a row of a model. A new token lets it go on.
    virtual void stop_when(std::stop_token) = 0;

    /// Keeps at most so much of stage outputs from here on, and as much as one run uses. Transparent fragments that take more
    /// than this are kept from one judge() to the next, but are dropped before runs are timed.
    virtual void limit_memo(std::uint64_t /*bytes*/) {}
    /// Drops every kept stage output and what frames left to the next (Graph::remember).
    virtual void forget_memo() = 0;
    /// Frees what the latest run's plan holds and gives the system back what is kept for the next one, on the device and on the
    /// host: for who runs many different requests.
    virtual void give_back_memory() {}
};

}  // namespace strata
