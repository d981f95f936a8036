// What a device can do, measured through its driver, and which share of it the steps of a frame reach.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "passes/graph/reached_code.h"
#include "replay/gpu/device.h"
#include "replay/isa/isa_report.h"
#include "replay/session/session.h"
#include "replay/tables/sheet.h"

namespace strata {

/// How much the measuring itself does: small for tests.
struct LimitWork {
    std::uint64_t copied_bytes = 64 << 20;                 ///< of one buffer to another
    std::uint32_t threads = 64 * 1024, iterations = 1024;  ///< of the loop of multiply-adds
    /// Copy and loop grow until each takes so long: below, a GPU's clocks and what a step costs besides decide. The copy grows as
    /// far as the device has memory and binds a buffer.
    double least_ms = 2;
    std::stop_token stop = {};  ///< asked between repeats
};

/// In units per second.
struct DeviceLimits {
    Spread bytes;                                         ///< read and written by a copy of a buffer
    Spread operations;                                    ///< a multiply-add is two
    std::uint64_t copied_bytes = 0, operations_done = 0;  ///< by one repeat: counted, the operations by the threads themselves
    std::uint32_t threads = 0, iterations = 0;            ///< LimitWork's, as large as they had to be
};
Result<DeviceLimits> measure_limits(Device&, std::size_t repeats, const LimitWork& = {});

/// Bytes that a step reads and writes of what it declares: every image and buffer once, whole, and once more where it is read
/// and written. Of a buffer that it only writes at most one element per invocation, in code without loops.
std::uint64_t declared_bytes(const Plan&, const PlannedStep&, std::optional<std::uint64_t> invocations);
/// Of its fragment or compute shader, by its constants.
OperationCount operations_per_invocation(const PlannedStep&);

struct StepShare {
    Scope scope;
    std::string name;
    Spread ms;
    std::uint64_t bytes = 0;
    std::optional<std::uint64_t> invocations;  ///< of the fragment or compute shader
    std::string counted_by;                    ///< IsaStep::counted_by
    OperationCount per_invocation;

    std::optional<double> operations() const;
};

struct DeviceBench {
    DeviceInfo device;
    DeviceLimits limits;
    std::string scene;
    std::size_t frame = 0, repeats = 0;
    std::uint32_t width = 0, height = 0, samples = 1;
    double frame_ms = 0;
    std::vector<StepShare> steps;            ///< the hottest, most time first
    std::string stopped = {};                ///< how many repeats there are where a stop was asked for
    std::string date = {}, capture_id = {};  ///< utc_date(); both the caller's

    /// Shares of the limits; the larger of the two says what the step is bound by, if anything.
    double share_of_bytes(const StepShare&) const;
    std::optional<double> share_of_operations(const StepShare&) const;
};

struct DeviceBenchWish {
    const Request& request;
    std::size_t repeats = 7;
    Progress progress = {};
    std::stop_token stop = {};
};

/// The hottest steps of a frame. Limits are measured on a device of their own. Stopped, it gives the steps by the repeats that
/// are complete, or fails (stopped) where there is none.
Result<DeviceBench> bench_device(Session&, Device& for_limits, const DeviceBenchWish&);

/// A row for each step.
Sheet sheet_of(const DeviceBench&);
Page page_of(const DeviceBench&);
std::string as_text(const DeviceBench&);
std::string as_json(const DeviceBench&);
std::string as_csv(const DeviceBench&);

}  // namespace strata
