// The session behind Session::open: one device, one capture, the frame that is loaded, the memo. What it does is spread over
// session.cpp (opening, running), timed_runs.cpp, step_counts.cpp, inspection.cpp (looking inside a frame, judging),
// memory_budget.cpp and reloaded_shaders.cpp.
#pragma once

#include <set>
#include <variant>

#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "passes/blend_rounding.h"
#include "passes/reference/fragments.h"
#include "replay/gpu/executor.h"
#include "replay/session/declaration.h"
#include "replay/session/memo.h"
#include "replay/session/memory_need.h"
#include "replay/session/session.h"

namespace strata {

class GlslSources;
struct ProductUses;
struct StepCounts;

class DeviceSession final : public Session {
public:
    /// Where frames come from: a file, or memory.
    using Source = std::variant<Capture, std::vector<Frame>>;

    /// memory_budget: as in DeviceChoice.
    DeviceSession(std::unique_ptr<Device>, Source, std::uint64_t memory_budget);
    /// On a device that outlives it and has no memory budget.
    DeviceSession(Device&, Source);

    const DeviceInfo& device() const override { return device_->info(); }
    const Capture* capture() const override { return std::get_if<Capture>(&source_); }
    std::size_t frame_count() const override;
    Result<Frame> frame(std::size_t index) override;

    Result<Run> run(const Request&) override;
    Result<Run> run_from(const Request&, Stage, const ImageSet& outputs) override;
    Result<std::vector<Run>> time(std::span<const Request>, std::size_t repeats, const Progress&) override;
    Result<PlannedFrame> plan(const Request&) override;
    Result<HostImage> peek(const Request&, std::size_t step, const std::string& image) override;
    Result<std::vector<StepImages>> step_images(const Request&, Stage) override;
    Result<std::vector<StepImages>> pixel_steps(const Request&, glm::uvec2 pixel) override;
    Result<std::vector<Cover>> draw_cover(const Request&, std::uint32_t draw) override;
    Result<ImageSet> stage_images(const Request&, Stage) override;
    Result<ImageSet> truth(const Request&, Stage) override;
    Result<Accuracy> judge(const Request&, Stage, Against, const ImageSet* truth) override;
    Result<const FragmentLists*> transparent_fragments(const Request&) override;
    Result<const FragmentLists*> row_fragments(const Request&, std::uint32_t y) override;
    Result<std::vector<Run>> run(Frame, std::span<const Request>) override;
    Result<ReloadedShaders> reload_shaders(const std::filesystem::path&, std::span<const Request> shown) override;
    void stop_when(std::stop_token stop) override { stop_ = std::move(stop); }
    void forget_memo() override;
    void limit_memo(std::uint64_t bytes) override;
    void give_back_memory() override;

    /// A run that executes everything, with what each step took and counted.
    struct TimedRun {
        Run run;
        std::vector<StepCost> step_costs;
        std::optional<double> empty_step_ms;
    };
    Result<TimedRun> time_alone(const Request&, const RunOptions& measured);
    Result<StepCounts> count(const Request&);   ///< see count_steps()
    Result<ProductUses> watch(const Request&);  ///< see product_uses()
    /// StepCounts::rasterized.
    Result<std::vector<std::optional<std::uint64_t>>> rasterize_steps(const Request&, const Declaration&);
    /// What one request took in one turn: its steps, and by stage what the host sorted, in milliseconds.
    struct RequestTimes {
        std::vector<StepCost> steps;
        std::map<std::string, double> sorts;
        std::optional<double> empty_step_ms;
    };
    using RepeatTimes = std::vector<RequestTimes>;
    /// Runs every request once, what they share once. The first turn makes the runs that the others add times to; counters are
    /// those of the last turn, in which state that outlives a frame (Graph::remember) is what it was when the times were taken.
    Result<RepeatTimes> time_one_repeat(std::span<const Request>, std::vector<Run>&, const RunOptions& measured, const Progress&);
    /// Runs the requests once more whose invocations are counted: no query stands in what is timed.
    Result<void> count_invocations(std::span<const Request>, std::vector<Run>&);
    /// The steps of a frame between two timestamps, so many times.
    Result<Spread> time_whole(const Request&, std::size_t repeats);
    Result<void> time_sorts(const Request&, const Run&, std::map<std::string, double>& sorts);

private:
    /// Every image as a stage's technique (its last pass) found it: the same for every technique of the stage, so the latest is
    /// kept, and the transparent fragments before it as soon as a model wants them.
    struct Found {
        std::vector<std::uint64_t> keys;  ///< of the passes before (PassKeys: the frame is in each); empty: never the same again
        ImageSet images;
        std::optional<FragmentLists> fragments;
        std::vector<LightFault> light_faults;
    };
    /// The outputs of a stage as its technique left them; found_ is what it found.
    struct Inspected {
        Choice choice;
        ImageSet result;
        std::vector<LightFault> light_faults;
    };
    /// Shaders compiled from a folder; those of the library stand in for the ones built in.
    struct ShaderSet {
        struct Compiled {
            std::uint64_t hash = 0;  ///< GlslSources::hash_of
            std::vector<std::uint32_t> code;
        };
        std::map<std::string, Compiled> compiled;  ///< by name; the library's shaders point into it
        ShaderLibrary library{&ShaderLibrary::built_in()};
    };
    /// Null when the shaders in use have no such one.
    const std::vector<std::uint32_t>* compiled_before(const std::string& shader, std::uint64_t hash) const;
    Result<std::unique_ptr<ShaderSet>> compile_set(const GlslSources&, ReloadedShaders&) const;
    const ShaderLibrary& shaders() const {
        return shader_sets_.empty() ? ShaderLibrary::built_in() : shader_sets_.back()->library;
    }
    enum class FoundImages { read, not_read };
    /// Fills found_ if asked to.
    Result<Inspected> inspect(const Request&, Stage, FoundImages = FoundImages::read);
    /// Of kept stage outputs, and of fragments beside them: a 1080p frame at four samples is about 1 GiB of outputs.
    static constexpr std::uint64_t memo_budget_bytes = std::uint64_t(1) << 30;
    /// Frees found_->fragments where they take more bytes than this.
    void drop_large_fragments(std::uint64_t most);
    /// What the loaded frame's technique of the stage needs of a device and this one does not have, or nothing.
    std::optional<std::string> lacking(const Request&, Stage) const;
    /// What is known of a run that executes everything, before any run.
    Result<Run> plan_run(const Request&);
    Result<Run> run_with_passes(const Request&);
    /// An image of light that a pass leaves, and its place among the peeks of a run.
    struct LightPeek {
        std::size_t pass = 0;
        std::string image;
        std::size_t peek = 0;
    };
    /// Adds peeks at what every pass leaves of light, as far as the run gets.
    static std::vector<LightPeek> peek_at_light(const Declaration&, RunOptions&);
    /// Looks for light that a pass could not hold.
    void check_light(const Declaration&, std::size_t pass, std::string_view image, const HostImage&, Run&) const;

    /// Loads the frame's variant when it is not the current one.
    Result<void> load_variant(const FrameVariant&);
    /// Loads the frame's variant and declares the request on it.
    Result<Declaration> prepare(const Request&, Memo*, Keep);
    Result<void> load(Frame, const FrameVariant&);
    /// Whether the device can bind every buffer whole and make every image.
    Result<void> check_sizes(const Plan&) const;
    /// Declares with the memo, as far as the budget leaves it room.
    Result<Declaration> prepare_with_memo(const Request&, const RunOptions&);
    MemoryNeed need_of(const Plan&, const RunOptions&) const;
    /// Refuses what the memory budget does not cover, before any of it is allocated.
    Result<void> check_budget(const Plan&, const RunOptions&) const;
    /// Makes room for a plan that uses nothing of the memo.
    Result<void> make_room(const Plan&, const RunOptions&);
    /// Fails once the device is lost, or whoever asked wants no answer any more.
    Result<void> check_going() const;
    void upload_scene();
    /// Makes a buffer that a plan imports; the caller has the executor forget it.
    Result<void> upload(ImportId, std::span<const std::byte>);
    /// Zeros for what frames leave to the next and none left yet.
    void make_remembered(const Plan&);
    /// Drops the work that frames left to the next (Remembered::work).
    void forget_work();
    /// The one place where a device's collapse becomes an Error.
    template <typename Action>
    std::invoke_result_t<Action> failures_as_errors(Action);
    /// Remembered work is found where an earlier frame did it, or all of it is done in this one.
    enum class Work { done, found };
    Result<Execution> execute(const Declaration&, RunOptions, Work = Work::done);
    /// Factor between recorded and stored radiance of the loaded frame.
    double pre_exposure() const { return loaded_->frame.pre_exposure; }
    /// An image of the loaded frame in the recorded unit of light.
    HostImage as_recorded(std::string_view name, HostImage) const;
    /// What is known of a run after it.
    Run finished(const Declaration&, const Execution&, std::optional<std::size_t> until = {});
    void remember(const Declaration&, const Execution&);
    /// Of the device; measured when it is first asked for.
    Result<BlendRounding> rounding();

    std::unique_ptr<Device> own_device_;  ///< null on a device of others
    Device* device_;
    std::unique_ptr<Executor> executor_;
    DeviceScene scene_;
    Memo memo_;
    std::unique_ptr<LoadedFrame> loaded_;
    std::optional<SceneRecords> not_uploaded_;  ///< the loaded frame's scene, until a plan is known to fit beside it
    std::uint64_t memory_budget_ = 0;
    std::map<std::uint64_t, Remembered> remembered_;  ///< buffers that are there, by their keys
    RunTimes times_;                                  ///< of the latest request
    std::optional<Found> found_;
    /// Of the latest row_fragments(), or of transparent_fragments() where the frame's unit of light is not the recorded one.
    std::optional<FragmentLists> recorded_fragments_;
    std::optional<BlendRounding> rounding_;
    std::vector<std::unique_ptr<ShaderSet>> shader_sets_;  ///< the last one is used; plans that were handed out point into others
    std::stop_token stop_;
    bool is_lost_ = false;
    Source source_;
};

}  // namespace strata
