#include "replay/gpu/executor.h"

#include <algorithm>
#include <set>

#include "capture_format/frame/frame.h"
#include "passes/settings.h"
#include "replay/gpu/device_memory.h"
#include "replay/gpu/host_timer.h"
#include "replay/gpu/opened_device.h"
#include "replay/gpu/plan_memory.h"
#include "replay/gpu/readback.h"
#include "replay/gpu/sample_layers.h"
#include "replay/gpu/step_recorder.h"
#include "replay/gpu/stopwatch.h"

namespace strata {
namespace {

/// Copies of images on their way to the host: they live until the commands have run.
struct HostCopies {
    struct Copy {
        std::size_t ticket = 0;
        Shape shape;
    };
    Readback readback;
    std::vector<std::unique_ptr<SampleLayers>> spread;

    Copy copy(const vk::raii::CommandBuffer& commands, const DeviceImage& image, std::optional<glm::uvec2> texel) {
        Shape shape = image.shape();
        shape.mips = 1;
        if (texel) shape.extent.width = shape.extent.height = 1;
        return {readback.add(commands, image, {shape, texel.value_or(glm::uvec2(0))}), shape};
    }
    HostImage take(const Copy& copy) const { return {copy.shape, readback.take(copy.ticket)}; }
};

/// Steps of a frame that are submitted together: amdgpu ends what takes longer than about 10 s.
struct Piece {
    vk::raii::CommandBuffer commands;
    std::size_t first = 0, end = 0;
};
/// A frame whose steps take longer than this, going by the latest run of its plan, is submitted in pieces.
constexpr double longest_submit_ms = 500;
/// Of a plan that was not run before.
constexpr std::size_t unknown_steps_per_submit = 16;
constexpr std::string_view watchdog_words = "the driver's watchdog ends a step that takes longer than it allows";

std::string text_of_step(const Plan& plan, std::size_t step) {
    return text_of(plan.scopes[plan.steps[step].step.scope]) + " / " + plan.steps[step].step.name;
}

std::string text_of_steps(const Plan& plan, const Piece& piece) {
    if (piece.first == piece.end) return "run the frame";
    const std::string first = text_of_step(plan, piece.first);
    if (piece.first + 1 == piece.end) return fmt::format("run '{}'", first);
    return fmt::format("run steps {} to {}, '{}' to '{}'", piece.first, piece.end - 1, first, text_of_step(plan, piece.end - 1));
}

std::size_t steps_to_run(const Plan& plan, const RunOptions& options) {
    return std::min(plan.steps.size(), options.until ? *options.until + 1 : plan.steps.size());
}

bool asks_of_steps(const RunOptions& options) {
    return options.timestamps == Timestamps::on || options.invocations == Invocations::counted;
}

/// Ids of the buffers that the steps write. Memory of all others holds what an earlier run left there.
std::set<std::uint32_t> written_buffers(std::span<const PlannedStep> steps) {
    std::set<std::uint32_t> ids;
    for (const PlannedStep& planned : steps)
        for (const Use& use : uses(planned))
            if (use.buffer && writes(use.access)) ids.insert(use.buffer.id);
    return ids;
}

void go_to(const vk::raii::CommandBuffer& commands, DeviceImage& image, const PartRange& range, vk::ImageLayout layout) {
    const auto barriers = image.transitions(range, layout, DeviceImage::Contents::keep);
    commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(barriers));
    image.set_layout(range, layout);
}

class VulkanExecutor final : public Executor {
public:
    explicit VulkanExecutor(OpenedDevice& device)
        : device_(&device), pipelines_(&device.pipelines()), samplers_(device), placeholders_(device), imports_(device) {}

    void upload(ImportId id, std::span<const std::byte> bytes) override {
        as_device_failure("upload", [&] { imports_.upload(id, bytes); });
    }
    void create_image(ImportId id, const Shape& shape) override {
        as_device_failure("create an imported image", [&] { imports_.create_image(id, shape); });
    }
    void forget(ImportId id) override { imports_.forget(id); }
    Execution run(const Plan& plan, const RunOptions& options) override {
        Execution execution;
        as_device_failure("prepare the frame", [&] { execution = record_and_submit(plan, options); });
        return execution;
    }
    std::size_t pipelines_created() const override { return pipelines_->created(); }
    DeviceMemory memory() const override {
        const PoolBytes& pool = device_->memory().bytes();
        return {memory_ ? memory_->bytes_held() : 0,
                imports_.bytes_held(),
                pool.in_use,
                pool.allocated,
                pool.peak_in_use,
                pool.peak_allocated};
    }
    std::uint64_t image_bytes(const Shape& shape) const override { return device_bytes(*device_, shape); }
    std::uint64_t buffer_bytes(std::uint64_t bytes) const override { return device_bytes(*device_, bytes, MemoryUse::buffers); }
    void forget_plan() override { memory_.reset(); }
    void give_back_memory() override {
        memory_.reset();
        device_->memory().give_back_empty();
    }

private:
    /// What one run needs besides the plan.
    struct Frame {
        const Plan& plan;
        const RunOptions& options;
        PlanResources resources;
        DescriptorSets sets;
        Stopwatch stopwatch;
        HostCopies peeks;
        std::vector<HostCopies::Copy> peeked;  // in the order they were asked for
    };

    Execution record_and_submit(const Plan&, const RunOptions&);
    std::size_t steps_per_submit(const Frame&) const;
    std::vector<Piece> record(Frame&);
    void record(const Piece&, Frame&);
    void submit(std::vector<Piece>&, const Frame&);
    HostCopies::Copy copy_out(const vk::raii::CommandBuffer&, DeviceImage&, HostCopies&, std::optional<glm::uvec2> texel = {});
    void record_peeks(const vk::raii::CommandBuffer&, Frame&, std::size_t step);
    void read_kept(Frame&, Execution&);
    void fail_on_messages();
    template <typename Action>
    void as_device_failure(std::string place, Action action);

    OpenedDevice* device_;
    PipelineStore* pipelines_;
    Samplers samplers_;
    Placeholders placeholders_;
    Imports imports_;
    std::optional<PlanMemory> memory_;   // of the latest plan
    std::optional<double> ms_per_step_;  // of its latest run
    std::string place_;                  // what is being done, for failures
};

/// Runs the action; whatever goes wrong becomes a DeviceFailure or MemoryLacks that says where, and the plan's memory starts
/// anew.
template <typename Action>
void VulkanExecutor::as_device_failure(std::string place, Action action) {
    place_ = std::move(place);
    try {
        try {
            action();
            fail_on_messages();
        } catch (...) {
            memory_.reset();
            throw;
        }
    } catch (const vk::DeviceLostError& problem) {
        throw DeviceLost("device.lost", fmt::format("{}: {}; {}", place_, problem.what(), watchdog_words));
    } catch (const vk::OutOfDeviceMemoryError& problem) {
        throw MemoryLacks("device.out_of_memory",
                          fmt::format("{}: the device has too little memory ({})", place_, problem.what()));
    } catch (const vk::OutOfHostMemoryError& problem) {
        throw MemoryLacks("device.out_of_host_memory",
                          fmt::format("{}: this machine has too little memory for the driver ({})", place_, problem.what()));
    } catch (const vk::SystemError& problem) {
        throw DeviceFailure("device.failed", fmt::format("{}: {}", place_, problem.what()));
    } catch (const std::out_of_range&) {
        throw DeviceFailure("device.no_import", fmt::format("{}: an imported resource was never made", place_));
    }
}

void VulkanExecutor::fail_on_messages() {
    if (!device_->instance().has_messages()) return;
    const auto messages = device_->take_messages();
    throw DeviceFailure("device.validation_message",
                        fmt::format("{}: the validation layer says ({} in all): {}", place_, messages.size(), messages.front()));
}

Execution VulkanExecutor::record_and_submit(const Plan& plan, const RunOptions& options) {
    Execution execution;
    HostTimer timer;
    if (!memory_ || !memory_->serves(plan)) {
        memory_.reset();
        ms_per_step_.reset();
        memory_.emplace(*device_, plan);
    }
    const auto intervals = static_cast<std::uint32_t>(std::max<std::size_t>(1, plan.steps.size()));
    Frame frame{plan,
                options,
                PlanResources(plan, *memory_, imports_),
                DescriptorSets(*device_, plan, samplers_, placeholders_),
                Stopwatch(*device_, intervals, options.invocations),
                {Readback(*device_), {}},
                std::vector<HostCopies::Copy>(options.peeks.size())};
    execution.host_ms.allocate = timer();
    const double pipelines_ms = pipelines_->milliseconds();
    const std::size_t pipelines_before = pipelines_->created();

    pipelines_->make(plan, steps_to_run(plan, options), options.stop);
    if (options.stop.stop_requested()) throw DeviceFailure("session.stopped", "stopped");
    std::vector<Piece> pieces;
    try {
        pieces = record(frame);
    } catch (...) {
        imports_.forget_use();
        throw;
    }
    execution.pipelines_created = pipelines_->created() - pipelines_before;
    execution.host_ms.pipelines = pipelines_->milliseconds() - pipelines_ms;
    execution.host_ms.record = timer() - execution.host_ms.pipelines;

    submit(pieces, frame);
    execution.host_ms.render = timer();
    ms_per_step_ = execution.host_ms.render / static_cast<double>(std::max<std::size_t>(1, pieces.back().end));
    fail_on_messages();

    std::vector<StepCost> costs = frame.stopwatch.costs();
    execution.empty_step_ms = frame.stopwatch.empty_ms();
    if (options.timestamps == Timestamps::around_all) execution.all_steps_ms = costs.at(0).ms;
    else execution.step_costs = std::move(costs);
    for (const HostCopies::Copy& copy : frame.peeked) execution.peeked.push_back(frame.peeks.take(copy));
    read_kept(frame, execution);
    execution.host_ms.read_back = timer();
    return execution;
}

std::size_t VulkanExecutor::steps_per_submit(const Frame& frame) const {
    if (frame.options.steps_per_submit) return *frame.options.steps_per_submit;
    if (!ms_per_step_) return unknown_steps_per_submit;
    return static_cast<std::size_t>(std::clamp(longest_submit_ms / *ms_per_step_, 1., 1e6));
}

std::vector<Piece> VulkanExecutor::record(Frame& frame) {
    const std::size_t end = steps_to_run(frame.plan, frame.options), steps = steps_per_submit(frame);
    std::vector<Piece> pieces;
    do {
        const std::size_t first = pieces.empty() ? 0 : pieces.back().end;
        pieces.push_back({device_->begin_commands(), first, std::min(first + steps, end)});
        record(pieces.back(), frame);
        pieces.back().commands.end();
    } while (pieces.back().end < end);
    return pieces;
}

/// One after the other, so that what is lost is lost in this one.
void VulkanExecutor::submit(std::vector<Piece>& pieces, const Frame& frame) {
    for (Piece& piece : pieces) {
        place_ = text_of_steps(frame.plan, piece);
        device_->submit(piece.commands);
    }
    place_ = "run the frame";
}

void VulkanExecutor::record(const Piece& piece, Frame& frame) {
    const Plan& plan = frame.plan;
    const vk::raii::CommandBuffer& commands = piece.commands;
    StepRecorder recorder(commands, plan, frame.resources, *pipelines_, frame.sets);
    const bool has_labels = device_->instance().has_labels(), is_last = piece.end == steps_to_run(plan, frame.options);
    const bool is_timed_whole = frame.options.timestamps == Timestamps::around_all;
    const bool is_timed = !is_timed_whole && asks_of_steps(frame.options);
    full_barrier(commands);  // what ran before is visible when it starts
    if (piece.first == 0 && frame.options.timestamps == Timestamps::on) frame.stopwatch.time_nothing(commands);
    if (piece.first == 0 && is_timed_whole) frame.stopwatch.begin(commands);
    for (std::size_t i = piece.first; i < piece.end; ++i) {
        const PlannedStep& planned = plan.steps[i];
        place_ = text_of_step(plan, i);
        if (has_labels) commands.beginDebugUtilsLabelEXT({place_.c_str()});
        if (is_timed) frame.stopwatch.begin(commands);
        recorder.barriers(planned.barriers);
        recorder.work(planned);
        if (is_timed) frame.stopwatch.end(commands);
        if (has_labels) commands.endDebugUtilsLabelEXT();
        record_peeks(commands, frame, i);
        fail_on_messages();
    }
    if (!is_last) return;
    if (is_timed_whole) frame.stopwatch.end(commands);
    if (piece.end == plan.steps.size()) recorder.barriers(plan.final_barriers);
    imports_.settle(commands);  // a shortened run leaves them anywhere
    frame.peeks.readback.finish(commands);
}

/// Copies mip 0 of an image between two steps, or one texel of it, and leaves it in the layouts it had.
HostCopies::Copy VulkanExecutor::copy_out(const vk::raii::CommandBuffer& commands, DeviceImage& image, HostCopies& copies,
                                          std::optional<glm::uvec2> texel) {
    const PartRange top{.layers = image.shape().layers};
    const auto before = image.layouts();
    HostCopies::Copy copy;
    if (image.shape().samples > 1) {
        auto& spread = copies.spread.emplace_back(std::make_unique<SampleLayers>(*device_, image, samplers_, placeholders_));
        const DeviceImage& layers = spread->record(commands, *pipelines_);
        copy = copies.copy(commands, layers, {});
    } else {
        go_to(commands, image, top, vk::ImageLayout::eTransferSrcOptimal);
        copy = copies.copy(commands, image, texel);
    }
    for (std::uint32_t layer = 0; layer < top.layers; ++layer) {
        if (before[layer] != vk::ImageLayout::eUndefined) go_to(commands, image, {.layer = layer}, before[layer]);
    }
    return copy;
}

void VulkanExecutor::record_peeks(const vk::raii::CommandBuffer& commands, Frame& frame, std::size_t step) {
    for (std::size_t i = 0; i < frame.options.peeks.size(); ++i) {
        const Peek& peek = frame.options.peeks[i];
        if (peek.step != step) continue;
        if (!frame.resources.holds(peek.image)) {
            throw DeviceFailure("device.image_holds_nothing", fmt::format("{}: the image {} holds nothing after this step",
                                                                          place_, frame.plan.images[peek.image.id].name));
        }
        frame.peeked[i] = copy_out(commands, frame.resources.image(peek.image), frame.peeks, peek.texel);
    }
}

/// What a shortened run did not get to is left out; so are imports, which are the caller's already.
void VulkanExecutor::read_kept(Frame& frame, Execution& execution) {
    place_ = "read the frame back";
    HostCopies copies{Readback(*device_), {}};
    std::map<std::uint32_t, HostCopies::Copy> images;
    std::map<std::uint32_t, std::size_t> buffers;
    const Plan& plan = frame.plan;
    device_->run_once([&](const vk::raii::CommandBuffer& commands) {
        full_barrier(commands);
        for (const Image image : plan.kept_images) {
            if (frame.options.kept_images == KeptImages::left) break;
            const bool is_there = !plan.images[image.id].import && frame.resources.holds(image);
            if (is_there) images[image.id] = copy_out(commands, frame.resources.image(image), copies);
        }
        const auto written = written_buffers(std::span(plan.steps).first(steps_to_run(plan, frame.options)));
        for (const Buffer buffer : plan.kept_buffers) {
            if (written.contains(buffer.id))
                buffers[buffer.id] = copies.readback.add(commands, frame.resources.buffer(buffer), plan.buffers[buffer.id].bytes);
        }
        copies.readback.finish(commands);
    });
    for (const auto& [id, copy] : images) execution.images[id] = copies.take(copy);
    for (const auto& [id, ticket] : buffers) execution.buffers[id] = copies.readback.take(ticket);
}

}  // namespace

std::unique_ptr<Executor> Executor::create(Device& device) {
    return std::make_unique<VulkanExecutor>(static_cast<OpenedDevice&>(device));
}

}  // namespace strata
