// The session behind Session::open: one device, one capture, the frame that is loaded, the memo. What it does is spread over
// session.cpp (opening, running), timed_runs.cpp, inspection.cpp (looking inside a frame, judging) and memory_budget.cpp.
#pragma once

#include <set>
#include <variant>

#include "passes/reference/fragments.h"
#include "replay/declaration.h"
#include "replay/gpu/executor.h"
#include "replay/memory_need.h"
#include "replay/session.h"

namespace strata {

class DeviceSession final : public Session {
public:
    /// Where frames come from: a file, or memory.
    using Source = std::variant<Capture, std::vector<Frame>>;

    /// memory_budget: as in DeviceChoice.
    DeviceSession(std::unique_ptr<Device>, Source, std::uint64_t memory_budget);

    const DeviceInfo& device() const override { return device_->info(); }
    const Capture* capture() const override { return std::get_if<Capture>(&source_); }
    std::size_t frame_count() const override;
    Result<Frame> frame(std::size_t index) override;

    Result<Run> run(const Request&) override;
    Result<std::vector<Run>> time(std::span<const Request>, std::size_t repeats) override;
    Result<PlannedFrame> plan(const Request&) override;
    Result<HostImage> peek(const Request&, std::size_t step, const std::string& image) override;
    Result<std::vector<StepImages>> step_images(const Request&, Stage) override;
    Result<ImageSet> truth(const Request&, Stage) override;
    Result<Accuracy> judge(const Request&, Stage, Against, const ImageSet* truth) override;
    Result<const FragmentLists*> transparent_fragments(const Request&) override;
    Result<std::vector<Run>> run(Frame, std::span<const Request>) override;
    void forget_memo() override;

    /// A run that executes everything, with what each step took and counted.
    struct TimedRun {
        Run run;
        std::vector<StepCost> step_costs;
    };
    Result<TimedRun> time_alone(const Request&);

private:
    /// Every image as a stage's technique (its last act) found it: the same for every technique of the stage, so the latest is
    /// kept, and the transparent fragments before it as soon as a model wants them.
    struct Found {
        std::uint64_t frame = 0;          ///< LoadedFrame::key
        std::vector<std::uint64_t> keys;  ///< of the acts before; empty: not known to be the same again
        ImageSet images;
        std::optional<FragmentLists> fragments;
    };
    /// The outputs of a stage as its technique left them; found_ is what it found.
    struct Inspected {
        Choice choice;
        ImageSet result;
    };
    Result<Inspected> inspect(const Request&, Stage);
    /// What is known of a run that executes everything, before any run.
    Result<Run> plan_run(const Request&);
    Result<Run> run_with_acts(const Request&);

    /// Loads the frame's variant when it is not the current one, and declares the request on it.
    Result<Declaration> prepare(const Request&, Memo*, Keep);
    Result<void> load(Frame, const FrameVariant&);
    /// Whether the device can bind every buffer whole.
    Result<void> check_buffers(const Plan&) const;
    /// Declares with the memo, as far as the budget leaves it room.
    Result<Declaration> prepare_with_memo(const Request&, const RunOptions&);
    MemoryNeed need_of(const Plan&, const RunOptions&) const;
    /// Refuses what the memory budget does not cover, before any of it is allocated.
    Result<void> check_budget(const Plan&, const RunOptions&) const;
    /// Makes room for a plan that uses nothing of the memo.
    Result<void> make_room(const Plan&, const RunOptions&);
    void upload_scene();
    /// Zeros for what frames leave to the next and none left yet.
    void make_remembered(const Plan&);
    /// The one place where a device's collapse becomes an Error.
    template <typename Action>
    std::invoke_result_t<Action> guarded(Action);
    Result<Execution> execute(const Declaration&, const RunOptions&);
    /// What is known of a run after it.
    Run finished(const Declaration&, const Execution&);
    void remember(const Declaration&, const Execution&);

    std::unique_ptr<Device> device_;
    std::unique_ptr<Executor> executor_;
    DeviceScene scene_;
    Memo memo_;
    std::unique_ptr<LoadedFrame> loaded_;
    std::optional<SceneRecords> not_uploaded_;  ///< the loaded frame's scene, until a plan is known to fit beside it
    std::uint64_t memory_budget_;
    std::set<std::uint64_t> remembered_;  ///< keys of buffers that are there
    RunTimes times_;                      ///< of the latest request
    std::optional<Found> found_;
    Source source_;
};

}  // namespace strata
