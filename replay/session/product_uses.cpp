#include "replay/session/product_uses.h"

#include "replay/session/device_session.h"

namespace strata {

Result<ProductUses> DeviceSession::watch(const Request& request) {
    auto declared = prepare(request, nullptr, Keep::outputs);
    if (!declared) return declared.error();
    const Work work = request.unchanged ? Work::found : Work::done;
    if (request.unchanged)
        if (const auto before = execute(*declared, {}, work); !before) return before.error();
    auto watched = WatchedPlan::of(declared->plan);
    if (!watched) return watched.error();
    ProductUses found{.products = {}, .scopes = declared->plan.scopes, .left_out = declared->plan.culled, .run = {}};
    Declaration marking = *std::move(declared);
    marking.plan = watched->plan();
    Result<void> uploaded = check_sizes(marking.plan);
    for (const auto& [id, bytes] : watched->uploads())
        if (uploaded) uploaded = upload(id, bytes);
    const auto execution = uploaded ? execute(marking, {}, work) : Result<Execution>(uploaded.error());
    for (const auto& [id, bytes] : watched->uploads()) executor_->forget(id);
    if (!execution) return execution.error();
    const auto marks = execution->buffers.find(watched->marks().id);
    found.products = watched->uses(marks == execution->buffers.end() ? std::span<const std::byte>() : marks->second);
    found.run = finished(marking, *execution);
    return found;
}

Result<ProductUses> product_uses(Session& session, const Request& request) {
    return static_cast<DeviceSession&>(session).watch(request);  // there is no other kind of session
}

}  // namespace strata
