#include "replay/gpu/stopwatch.h"

#include "replay/gpu/opened_device.h"
#include "replay/gpu/step_recorder.h"

namespace strata {

Stopwatch::Stopwatch(const OpenedDevice& device, std::uint32_t intervals)
    : period_ns_(device.timestamp_period_ns()),
      capacity_(2 * intervals),
      pool_(device.handle(), vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, capacity_)) {
    pool_.reset(0, capacity_);
}

void Stopwatch::write(const vk::raii::CommandBuffer& commands) {
    full_barrier(commands);
    commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *pool_, written_++);
    full_barrier(commands);
}

void Stopwatch::begin(const vk::raii::CommandBuffer& commands) { write(commands); }

void Stopwatch::end(const vk::raii::CommandBuffer& commands) { write(commands); }

std::vector<double> Stopwatch::milliseconds() const {
    std::vector<double> intervals;
    if (written_ == 0) return intervals;
    const auto [result, ticks] =
        pool_.getResults<std::uint64_t>(0, written_, written_ * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                        vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    for (std::size_t i = 0; i + 1 < ticks.size(); i += 2) {
        intervals.push_back(static_cast<double>(ticks[i + 1] - ticks[i]) * period_ns_ * 1e-6);
    }
    return intervals;
}

}  // namespace strata
