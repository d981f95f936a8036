#include "replay/session/step_counts.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "passes/technique.h"
#include "replay/session/describe_run.h"
#include "replay/session/device_session.h"

namespace strata {
namespace {

/// Null where the step's groups are known before the frame runs.
const ComputeWork* indirect_work(const PlannedStep& planned) {
    const auto* compute = std::get_if<ComputeWork>(&planned.step.work);
    return compute && compute->arguments ? compute : nullptr;
}

/// Whether the frame makes all arguments, and they are still in their buffers at its end.
bool keeps_arguments(const Plan& plan) {
    return std::ranges::all_of(plan.steps, [&](const PlannedStep& planned) {
        const ComputeWork* work = indirect_work(planned);
        if (!work) return true;
        const BufferRecord& buffer = plan.buffers[work->arguments.id];
        return !buffer.import && buffer.version == work->arguments.version;
    });
}

/// Those that tell by fragments_counter what one of their draws did.
std::set<const Technique*> counting_techniques(const Declaration& d) {
    const std::set<std::string> not_whole = not_counted(d, {});
    std::set<const Technique*> found;
    for (const CounterSource& source : d.counters) {
        const bool counts = std::ranges::count(source.technique->counters, fragments_counter, &Counter::name) > 0;
        if (counts && draws_once(d.plan, source.scope) && !not_whole.contains(std::string(source.technique->name)))
            found.insert(source.technique);
    }
    return found;
}

std::uint64_t invocations(const PlannedStep& planned, std::span<const std::byte> arguments) {
    std::array<std::uint32_t, 3> groups{};
    std::memcpy(groups.data(), &arguments[indirect_work(planned)->arguments_offset], sizeof groups);
    const Extent threads = group_size(planned);
    return std::uint64_t{groups[0]} * groups[1] * groups[2] * threads.width * threads.height * threads.depth;
}

Result<StepCounts> count_everything(DeviceSession& session, const Request& request) {
    auto timed = session.time_alone(request);
    if (!timed) return timed.error();
    StepCounts counts{.counters = std::move(timed->run.counters)};
    for (const StepCost& cost : timed->step_costs) counts.invocations.push_back(cost.invocations);
    return counts;
}

}  // namespace

bool draws_once(const Plan& plan, std::uint32_t scope) {
    return std::ranges::count_if(plan.steps, [&](const PlannedStep& planned) {
               return planned.step.scope == scope && std::holds_alternative<DrawWork>(planned.step.work);
           }) == 1;
}

Result<StepCounts> DeviceSession::count(const Request& request) {
    const auto whole = prepare(request, nullptr, Keep::outputs);
    if (!whole) return whole.error();
    const Plan& plan = whole->plan;
    if (!device().software || !keeps_arguments(plan)) return count_everything(*this, request);
    StepCounts counts{.invocations = std::vector<std::optional<std::uint64_t>>(plan.steps.size()), .counters = {}};
    const std::set<const Technique*> counting = counting_techniques(*whole);
    if (counting.empty() && std::ranges::none_of(plan.steps, indirect_work)) return counts;
    const auto declared = declare_counts(request, {*loaded_, scene_, device(), shaders()}, plan, counting);
    if (!declared) return declared.error();
    const auto execution = execute(*declared, {.kept_images = KeptImages::left});
    if (!execution) return execution.error();
    counts.counters = summed(read_counters(*declared, *execution));
    std::erase_if(counts.counters, [&](const CounterRecord& record) {
        return std::ranges::none_of(counting, [&](const Technique* technique) { return technique->name == record.technique; });
    });
    for (std::size_t i = 0; i < plan.steps.size(); ++i)
        if (const ComputeWork* work = indirect_work(plan.steps[i]))
            counts.invocations[i] = invocations(plan.steps[i], execution->buffers.at(work->arguments.id));
    return counts;
}

Result<StepCounts> count_steps(Session& session, const Request& request) {
    return static_cast<DeviceSession&>(session).count(request);  // there is no other kind of session
}

}  // namespace strata
