// Techniques that stand in for the truth of their stage.
#pragma once

#include <optional>

#include "replay/session/session.h"

namespace strata {

/// Whether a run's notes say nothing of the technique: one that stands in for the truth does not where it names a limitation of
/// its own.
bool notes_no_limitation(const Run&, const Technique&);

/// The request with the first technique that stands in for the stage's truth and can do the frame; nothing where none does.
Result<std::optional<Request>> stand_in(Session&, Stage, const Request& base);

}  // namespace strata
