#include "replay/session/step_counts.h"

#include "replay/session/device_session.h"

namespace strata {

Result<StepCounts> count_steps(Session& session, const Request& request) {
    auto timed = static_cast<DeviceSession&>(session).time_alone(request);  // there is no other kind of session
    if (!timed) return timed.error();
    StepCounts counts{.counters = std::move(timed->run.counters)};
    for (const StepCost& cost : timed->step_costs) counts.invocations.push_back(cost.invocations);
    return counts;
}

}  // namespace strata
