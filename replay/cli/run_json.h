// A run as files and scripts see it: where it comes from, and all of it as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "replay/expectation_check.h"
#include "replay/image_io.h"

namespace strata {

/// What a picture needs to be traced back; the same block is in the EXR header and in the JSON.
Metadata provenance(const Session&, const Request&, const Run&);

/// Schema strata.replay. `verdict` where the run was held against what its capture expects, else null.
nlohmann::ordered_json json_of(const Metadata& provenance, const Run&, const ExpectationVerdict* verdict);

}  // namespace strata
