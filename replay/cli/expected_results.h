// Results that a replay is compared with: those accepted for the capture itself, or for another one, such as the capture that was
// recorded before a change. Frames of both belong together by index.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "capture_format/reader.h"
#include "replay/cli/verb_options.h"
#include "replay/expectations/expectation.h"

namespace strata {

struct ExpectedResults {
    std::optional<Capture> other;  ///< none: the session's own
    std::vector<Expectation> expectations;

    /// The capture that keeps the expectations.
    const Capture& capture(const Session& session) const { return other ? *other : *session.capture(); }
};

/// Those of a session that was opened with these options; an empty path means its own capture. Fails (usage) where the other
/// capture lacks one of the frames, or has it at another size.
Result<ExpectedResults> expected_results(Session&, const OpenOptions&, const std::filesystem::path& other,
                                         std::span<const std::size_t> frames);

}  // namespace strata
