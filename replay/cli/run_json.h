// A run as scripts see it: all of it as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "replay/expectations/expectation_check.h"
#include "replay/expectations/provenance.h"
#include "replay/tables/document.h"
#include "replay/tables/sheet.h"

namespace strata {

/// Schema strata.replay. `verdict` where the run was held against what its capture expects, else null.
nlohmann::ordered_json json_of(const DocumentHead&, const Metadata& provenance, const Run&, const ExpectationVerdict* verdict);

/// The steps, with their times where these were measured.
Sheet steps_of(const Run&, std::size_t frame);

}  // namespace strata
