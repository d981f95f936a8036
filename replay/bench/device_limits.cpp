// What a device can do: bytes that a copy moves, and multiply-adds of a loop.
#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "passes/graph/graph.h"
#include "passes/shaders/multiply_add.shared.h"
#include "replay/bench/device_bench.h"
#include "replay/gpu/device_memory.h"
#include "replay/gpu/executor.h"

namespace strata {
namespace {

/// Steps: a clear, the copy, a look at it, the loop.
constexpr std::size_t copy_step = 1, loop_step = 3;
Graph work_of(const LimitWork& work, Buffer& done) {
    Graph graph;
    Buffer from = graph.create("from", work.copied_bytes), to = graph.create("to", work.copied_bytes);
    graph.clear(from, 1);
    graph.copy(from, to);
    Buffer first = graph.create("first", sizeof(std::uint32_t));
    graph.compute("shaders/first_word.comp").loads("From", to).stores("First", first).groups({1, 1, 1});
    graph.keep(first);
    done = graph.create("done", std::uint64_t{work.threads} * sizeof(std::uint32_t));
    graph.compute("shaders/multiply_add.comp")
        .stores("Done", done)
        .push(MultiplyAdd{.factor = 1, .summand = 1, .iterations = work.iterations})
        .groups({work.threads / multiply_add_threads, 1, 1});
    graph.keep(done);
    return graph;
}

/// What the threads counted: two operations for every multiply-add.
std::uint64_t operations_done(const std::vector<std::byte>& counted) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < counted.size(); i += sizeof(std::uint32_t)) {
        std::uint32_t done = 0;
        std::memcpy(&done, counted.data() + i, sizeof done);
        sum += done;
    }
    return 2 * sum;
}

/// What one run of the work took.
struct LimitTimes {
    double copy_ms = 0, loop_ms = 0;
    std::uint64_t copied_bytes = 0, operations_done = 0;
};

class LimitMeasurement {
public:
    LimitMeasurement(Device& device, LimitWork work)
        : executor_(Executor::create(device)),
          most_bytes_(device.info().max_buffer_bytes & ~std::uint64_t{3}),
          work_(std::move(work)) {}

    const LimitWork& work() const { return work_; }
    Result<LimitTimes> run();
    /// Makes the work larger until copy and loop take long enough, as far as the device goes.
    Result<void> grow();

private:
    /// Whether anything could be made larger that is too short.
    bool enlarge(double copy_ms, double loop_ms);

    std::unique_ptr<Executor> executor_;
    std::uint64_t most_bytes_;
    LimitWork work_;
};

Result<LimitTimes> LimitMeasurement::run() {
    if (work_.stop.stop_requested()) return fail(Fault::stopped, "session.stopped", "stopped before a step was timed");
    Buffer done;
    const auto plan = compile(work_of(work_, done), ShaderLibrary::built_in());
    if (!plan) return plan.error();
    const Execution run = executor_->run(*plan, {.timestamps = Timestamps::on});
    return LimitTimes{.copy_ms = run.step_costs[copy_step].ms,
                      .loop_ms = run.step_costs[loop_step].ms,
                      .copied_bytes = declared_bytes(*plan, plan->steps[copy_step], {}),
                      .operations_done = operations_done(run.buffers.at(done.id))};
}

bool LimitMeasurement::enlarge(double copy_ms, double loop_ms) {
    // Threads first: 65,536 of them do not fill a large GPU. llvmpipe ends loops after 65,535 iterations.
    constexpr std::uint32_t most_threads = 1 << 20, most_iterations = 32'768;
    const LimitWork before = work_;
    if (copy_ms < work_.least_ms)
        work_.copied_bytes = std::max(work_.copied_bytes, std::min(2 * work_.copied_bytes, most_bytes_));
    if (loop_ms < work_.least_ms && work_.threads < most_threads) work_.threads *= 2;
    else if (loop_ms < work_.least_ms && work_.iterations < most_iterations) work_.iterations *= 2;
    return work_.copied_bytes > before.copied_bytes || work_.threads > before.threads || work_.iterations > before.iterations;
}

Result<void> LimitMeasurement::grow() {
    for (std::uint64_t fitting_bytes = work_.copied_bytes;;) {
        try {
            const auto cold = run(), warm = cold ? run() : cold;
            if (!warm) return warm.error();
            fitting_bytes = work_.copied_bytes;
            if (!enlarge(std::min(cold->copy_ms, warm->copy_ms), std::min(cold->loop_ms, warm->loop_ms))) return {};
        } catch (const MemoryLacks&) {
            if (work_.copied_bytes == fitting_bytes) throw;
            executor_->give_back_memory();
            work_.copied_bytes = most_bytes_ = fitting_bytes;
        }
    }
}

}  // namespace

Result<DeviceLimits> measure_limits(Device& device, std::size_t repeats, const LimitWork& work) {
    DeviceLimits limits;
    std::vector<double> bytes, operations;
    try {
        LimitMeasurement measurement(device, work);
        if (const auto grown = measurement.grow(); !grown) return grown.error();
        for (std::size_t turn = 0; turn < repeats; ++turn) {
            const auto times = measurement.run();
            if (!times) return times.error();
            if (times->copy_ms <= 0 || times->loop_ms <= 0)
                return fail(Fault::device_lacks, "bench.clock_too_coarse",
                            "the device's timestamps are too coarse to measure what it can do");
            limits.copied_bytes = times->copied_bytes;
            limits.operations_done = times->operations_done;
            bytes.push_back(1e3 * static_cast<double>(times->copied_bytes) / times->copy_ms);
            operations.push_back(1e3 * static_cast<double>(times->operations_done) / times->loop_ms);
        }
        limits.threads = measurement.work().threads;
        limits.iterations = measurement.work().iterations;
    } catch (const DeviceFailure& failure) {
        return fail(Fault::device_failed, failure.id(), "the limits of the device cannot be measured: {reason}", failure.what());
    }
    limits.bytes = spread_of(bytes);
    limits.operations = spread_of(operations);
    return limits;
}

}  // namespace strata
