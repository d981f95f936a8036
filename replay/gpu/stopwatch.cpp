#include "replay/gpu/stopwatch.h"

#include <algorithm>
#include <cassert>

#include "replay/gpu/opened_device.h"
#include "replay/gpu/step_recorder.h"

namespace strata {
namespace {

// In the order of their bits: that of the results.
constexpr vk::QueryPipelineStatisticFlags counted = vk::QueryPipelineStatisticFlagBits::eFragmentShaderInvocations |
                                                    vk::QueryPipelineStatisticFlagBits::eComputeShaderInvocations;
constexpr std::uint32_t counts = 2;
/// Odd, for a median that was measured; the first can be slower than others.
constexpr std::uint32_t empty_intervals = 5;

/// The first `count` results of a pool, `each` numbers wide.
std::vector<std::uint64_t> results(const vk::raii::QueryPool& pool, std::uint32_t count, std::uint32_t each) {
    const std::size_t bytes = each * sizeof(std::uint64_t);
    return pool
        .getResults<std::uint64_t>(0, count, count * bytes, bytes, vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait)
        .second;
}

}  // namespace

Stopwatch::Stopwatch(const OpenedDevice& device, std::uint32_t intervals, Invocations wanted)
    : period_ns_(device.timestamp_period_ns()),
      mask_(device.timestamp_mask()),
      times_(device.handle(), vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 2 * (empty_intervals + intervals))) {
    times_.reset(0, 2 * (empty_intervals + intervals));
    if (wanted == Invocations::not_counted || !device.counts_invocations()) return;
    invocations_.emplace(device.handle(), vk::QueryPoolCreateInfo({}, vk::QueryType::ePipelineStatistics, intervals, counted));
    invocations_->reset(0, intervals);
}

void Stopwatch::write_time(const vk::raii::CommandBuffer& commands) {
    full_barrier(commands);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *times_, written_++);
    full_barrier(commands);
}

void Stopwatch::begin(const vk::raii::CommandBuffer& commands) {
    write_time(commands);
    if (invocations_) commands.beginQuery(**invocations_, begun_, {});
    ++begun_;
}

void Stopwatch::end(const vk::raii::CommandBuffer& commands) {
    if (invocations_) commands.endQuery(**invocations_, begun_ - 1);
    write_time(commands);
}

void Stopwatch::time_nothing(const vk::raii::CommandBuffer& commands) {
    assert(written_ == 0);
    for (; empty_ < empty_intervals; ++empty_) {
        write_time(commands);
        write_time(commands);
    }
}

std::vector<double> Stopwatch::milliseconds() const {
    if (written_ == 0) return {};
    const std::vector<std::uint64_t> ticks = results(times_, written_, 1);
    std::vector<double> ms;
    for (std::size_t i = 0; i + 1 < ticks.size(); i += 2)
        ms.push_back(static_cast<double>((ticks[i + 1] - ticks[i]) & mask_) * period_ns_ * 1e-6);
    return ms;
}

std::optional<double> Stopwatch::empty_ms() const {
    if (empty_ == 0) return {};
    std::vector<double> ms = milliseconds();
    ms.resize(empty_);
    std::ranges::sort(ms);
    return ms[ms.size() / 2];
}

std::vector<StepCost> Stopwatch::costs() const {
    std::vector<StepCost> intervals(begun_);
    if (begun_ == 0) return intervals;
    const std::vector<double> ms = milliseconds();
    for (std::size_t i = 0; i < begun_; ++i) intervals[i].ms = ms[empty_ + i];
    if (!invocations_) return intervals;
    const std::vector<std::uint64_t> numbers = results(*invocations_, begun_, counts);
    for (std::size_t i = 0; i < begun_; ++i) intervals[i].invocations = numbers[counts * i] + numbers[counts * i + 1];
    return intervals;
}

}  // namespace strata
