// The session behind Session::open: one device, one capture, the frame that is loaded, the memo. What it does is spread over
// session.cpp (opening, running, timing) and inspection.cpp (looking inside a frame, judging).
#pragma once

#include <variant>

#include "replay/declaration.h"
#include "replay/gpu/executor.h"
#include "replay/session.h"

namespace strata {

class DeviceSession final : public Session {
public:
    /// Where frames come from: a file, or memory.
    using Source = std::variant<Capture, std::vector<Frame>>;

    DeviceSession(std::unique_ptr<Device>, Source);

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
    void forget_memo() override { memo_.clear(); }

private:
    /// Every image as a stage's technique (its last act) found it, and the stage's outputs as it left them.
    struct Inspected {
        Choice choice;
        ImageSet before, result;
    };
    Result<Inspected> inspect(const Request&, Stage);
    Result<Run> run_with_acts(const Request&);

    /// Loads the frame's variant when it is not the current one, and declares the request on it.
    Result<Declaration> prepare(const Request&, Memo*, Keep);
    /// Whether the device can bind every buffer whole.
    Result<void> check_buffers(const Plan&) const;
    /// The one place where a device's collapse becomes an Error.
    Result<Execution> execute(const Declaration&, const RunOptions&);
    void remember(const Declaration&, const std::vector<CounterRecord>&);

    std::unique_ptr<Device> device_;
    std::unique_ptr<Executor> executor_;
    DeviceScene scene_;
    Memo memo_;
    std::unique_ptr<LoadedFrame> loaded_;
    Source source_;
};

}  // namespace strata
