// Runs a plan: barrier, label, timestamp pair, bind by name, go. Knows no technique. Everything Vulkan stays behind this
// header; exceptions of vk::raii leave it only as vk::SystemError, which Session::run catches (through DeviceFailure).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "passes/graph/plan.h"
#include "replay/gpu/device.h"
#include "replay/host_image.h"

namespace strata {

/// The device collapsed or the validation layer complained; what() names the step.
class DeviceFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An image to copy out right after a step of the plan (its index in Plan::steps). A DeviceFailure when no step made it yet, or
/// a later image has taken its memory.
struct Peek {
    std::size_t step = 0;
    Image image;
};

enum class Timestamps { off, on };
/// Whether the host reads the images that the graph keeps. They are made either way.
enum class KeptImages { read, left };

struct RunOptions {
    std::optional<std::size_t> until;  ///< last step to run, all of them where empty
    std::vector<Peek> peeks;
    Timestamps timestamps = Timestamps::off;
    KeptImages kept_images = KeptImages::read;
};

struct Execution {
    std::vector<double> step_ms;  ///< one per executed step with timestamps on
    double wall_ms = 0;           ///< submit to fence
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
    /// Device bytes held for plans and for imports.
    virtual std::uint64_t bytes_held() const = 0;
};

}  // namespace strata
