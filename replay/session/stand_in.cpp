#include "replay/session/stand_in.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "passes/registry.h"
#include "passes/technique.h"

namespace strata {

bool notes_no_limitation(const Run& run, const Technique& technique) {
    const std::string begin = fmt::format("{}: ", technique.name);
    return std::ranges::none_of(run.notes, [&](const std::string& note) { return note.starts_with(begin); });
}

Result<std::optional<Request>> stand_in(Session& session, Stage stage, const Request& base) {
    const auto planned = session.plan(base);
    if (!planned) return planned.error();
    for (const Technique* technique : techniques_of(stage)) {
        if (!technique->abilities.stands_in_for_truth || unsupported(*technique, planned->features)) continue;
        Request request = base;
        request.choices.drop(stage);
        request.choices.use(*technique);
        const auto run = session.run(request);
        if (!run && run.error().fault == Fault::device_lacks) continue;
        if (!run) return run.error();
        if (notes_no_limitation(*run, *technique)) return std::optional(std::move(request));
    }
    return std::optional<Request>();
}

}  // namespace strata
