// A run as scripts see it: all of it as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "replay/expectations/expectation_check.h"
#include "replay/expectations/provenance.h"

namespace strata {

/// Schema strata.replay. `verdict` where the run was held against what its capture expects, else null.
nlohmann::ordered_json json_of(const Metadata& provenance, const Run&, const ExpectationVerdict* verdict);

}  // namespace strata
