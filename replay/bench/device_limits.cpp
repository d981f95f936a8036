// What a device can do: bytes that a copy moves, and multiply-adds of a loop.
#include <cstring>

#include "passes/graph/graph.h"
#include "passes/shaders/multiply_add.shared.h"
#include "replay/bench/device_bench.h"
#include "replay/gpu/executor.h"

namespace strata {
namespace {

/// Steps: a clear, the copy, the loop.
Graph work_of(const LimitWork& work, Buffer& done) {
    Graph graph;
    Buffer from = graph.create("from", work.copied_bytes), to = graph.create("to", work.copied_bytes);
    graph.clear(from, 1);
    graph.copy(from, to);
    graph.keep(to);
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

}  // namespace

Result<DeviceLimits> measure_limits(Device& device, std::size_t repeats, const LimitWork& work) {
    Buffer done;
    const auto plan = compile(work_of(work, done), ShaderLibrary::built_in());
    if (!plan) return plan.error();
    const auto executor = Executor::create(device);
    DeviceLimits limits{.copied_bytes = declared_bytes(*plan, plan->steps[1], {})};
    std::vector<double> bytes, operations;
    try {
        for (std::size_t turn = 0; turn <= repeats; ++turn) {  // the first warms up
            if (work.stop.stop_requested()) return fail(Fault::stopped, "session.stopped", "stopped before a step was timed");
            const Execution run = executor->run(*plan, {.timestamps = Timestamps::on});
            limits.operations_done = operations_done(run.buffers.at(done.id));
            const double copy_ms = run.step_costs[1].ms, loop_ms = run.step_costs[2].ms;
            if (copy_ms <= 0 || loop_ms <= 0)
                return fail(Fault::device_lacks, "bench.clock_too_coarse",
                            "the device's timestamps are too coarse to measure what it can do");
            if (turn == 0) continue;
            bytes.push_back(1e3 * static_cast<double>(limits.copied_bytes) / copy_ms);
            operations.push_back(1e3 * static_cast<double>(limits.operations_done) / loop_ms);
        }
    } catch (const DeviceFailure& failure) {
        return fail(Fault::device_failed, failure.id(), "the limits of the device cannot be measured: {reason}", failure.what());
    }
    limits.bytes = spread_of(bytes);
    limits.operations = spread_of(operations);
    return limits;
}

}  // namespace strata
