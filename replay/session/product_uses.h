// How much of what a frame makes anybody reads, by running it with shaders that mark their reads and writes.
#pragma once

#include <vector>

#include "passes/graph/watch/watched_plan.h"
#include "replay/session/session.h"

namespace strata {

struct ProductUses {
    std::vector<ProductUse> products;  ///< by steps of Session::plan()
    std::vector<Scope> scopes;         ///< of the plan
    std::vector<CulledStep> left_out;  ///< steps and products that the frame does without
    Run run;                           ///< what the watched frame gave: the same as without marks
};

/// Runs the frame once, everything executed; with Request::unchanged a frame that follows itself. Several times as slow as the
/// frame, and as much memory as marks take: a bit for each texel and word and technique that reads it.
Result<ProductUses> product_uses(Session&, const Request&);

}  // namespace strata
