// Choices that have no effect, because the frame leaves their stage out.
#pragma once

#include <set>
#include <string>

#include "replay/session/session.h"

namespace strata {

class LeftOutNotes {
public:
    /// Says on standard error which of the request's techniques and settings have no effect on its frame, why, and which option
    /// would run them; each once, on the first of several frames. Declares the frame where there are any.
    Result<void> tell(Session& session, const Request& request) { return tell(session, request, request.choices); }
    /// The same for a request to which the verb adds choices of its own: of those that were asked for.
    Result<void> tell(Session&, const Request&, const ChoiceChanges& asked);

private:
    std::set<std::string> told_;
};

}  // namespace strata
