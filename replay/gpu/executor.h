// Runs a plan: barrier, label, timestamp pair, bind by name, go. Knows no technique. Everything Vulkan stays behind this
// header; exceptions of vk::raii leave it only as vk::SystemError, which Session::run catches (through DeviceFailure).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

#include "passes/graph/plan.h"
#include "replay/gpu/device.h"
#include "replay/images/host_image.h"

namespace strata {

/// The device collapsed or the validation layer complained; what() names the step.
class DeviceFailure : public std::runtime_error {
public:
    DeviceFailure(ErrorId id, const std::string& what) : std::runtime_error(what), id_(id) {}
    ErrorId id() const { return id_; }

private:
    ErrorId id_;
};

/// Nothing works any more on this device.
class DeviceLost : public DeviceFailure {
public:
    using DeviceFailure::DeviceFailure;
};

/// An image to copy out right after a step of the plan (its index in Plan::steps). A DeviceFailure when no step made it yet, or
/// a later image has taken its memory.
struct Peek {
    std::size_t step = 0;
    Image image;
    std::optional<glm::uvec2> texel = {};  ///< that column of every layer and slice alone; not of several samples
};

/// Around every step, with barriers; or one pair around all of them, with nothing between steps.
enum class Timestamps { off, on, around_all };
/// Whether the device counts how often shaders run: queries around every step, which cost time.
enum class Invocations { not_counted, counted };
/// Whether the host reads the images that the graph keeps. They are made either way.
enum class KeptImages { read, left };

struct RunOptions {
    std::optional<std::size_t> until;  ///< last step to run, all of them where empty
    std::vector<Peek> peeks;
    Timestamps timestamps = Timestamps::off;
    KeptImages kept_images = KeptImages::read;
    std::stop_token stop;  ///< once requested nothing is submitted any more: a DeviceFailure
    /// Steps that are submitted together; empty: by what the plan took before, so that no driver's watchdog ends them.
    std::optional<std::size_t> steps_per_submit;
    Invocations invocations = Invocations::not_counted;
};

/// Device memory in bytes, by the allocator's own count.
struct DeviceMemory {
    std::uint64_t plan = 0, imports = 0;      ///< of the latest plan's images and buffers; of what outlives plans
    std::uint64_t in_use = 0, allocated = 0;  ///< by all of them and what is read back; taken from the device for them
    std::uint64_t peak_in_use = 0, peak_allocated = 0;
};

/// Where a run spent the host's time, in milliseconds.
struct HostTimes {
    double allocate = 0, pipelines = 0, record = 0, render = 0, read_back = 0;  ///< render: submit to fence
};

/// What a step took on the device.
struct StepCost {
    double ms = 0;
    std::optional<std::uint64_t> invocations;  ///< of fragment and compute shaders, where they were asked for and are counted
};

struct Execution {
    std::vector<StepCost> step_costs;  ///< one per executed step with timestamps on, or invocations counted
    /// With timestamps on: a step that does nothing takes this, and so much of every step's time is not its own. Median of a few.
    std::optional<double> empty_step_ms;
    std::optional<double> all_steps_ms;  ///< with one pair around all of them
    HostTimes host_ms;
    std::size_t pipelines_created = 0;
    // Images with several samples come back as layers, their depth as r32f. A shortened run gives what it made.
    std::map<std::uint32_t, HostImage> images;                ///< kept images by id, imports excluded
    std::map<std::uint32_t, std::vector<std::byte>> buffers;  ///< kept buffers by id
    std::vector<HostImage> peeked;                            ///< in the order of RunOptions::peeks
};

class Executor {
public:
    static std::unique_ptr<Executor> create(Device&);
    virtual ~Executor() = default;

    /// Creates or replaces a resource that outlives plans, known to Graph::import by its id. Images are zero at first.
    virtual void upload(ImportId, std::span<const std::byte>) = 0;
    virtual void create_image(ImportId, const Shape&) = 0;
    virtual void forget(ImportId) = 0;

    /// Throws DeviceFailure. Pipelines and the plan's memory are kept for the next run of an equal plan.
    virtual Execution run(const Plan&, const RunOptions&) = 0;

    /// Pipelines made so far: what "only what the scene calls for" counts.
    virtual std::size_t pipelines_created() const = 0;
    virtual DeviceMemory memory() const = 0;
    /// What an image of a shape and a buffer take of the device.
    virtual std::uint64_t image_bytes(const Shape&) const = 0;
    virtual std::uint64_t buffer_bytes(std::uint64_t bytes) const = 0;
    /// Frees what the latest plan holds.
    virtual void forget_plan() = 0;
    /// The same, and gives the device back all memory that nothing lies in: the next run takes it anew.
    virtual void give_back_memory() = 0;
};

}  // namespace strata
