// Which technique answers a question that not all can answer.
#pragma once

#include <string_view>

#include "replay/session/frame_plan.h"

namespace strata {

/// What a verb needs of a technique, and how to say that one has it not.
struct Offer {
    bool (*is_made_by)(const Technique&);
    std::string_view lacking;  ///< "makes no feature spectra"
};

/// The technique that makes the offer: the one of its stage that is chosen, which must be such a one, else the first on the
/// list. Fails (usage) with the names of those that do.
Result<const Technique*> technique_offering(const Offer&, const ChoiceChanges&);

}  // namespace strata
