// The named functions compile() is made of, in the order in which it calls them.
#pragma once

#include "passes/graph/plan.h"

namespace strata {

/// Finds the step's shaders, gives every binding its place, and checks that declaration and shaders fit together.
Result<PlannedStep> check_step(const Graph&, const Step&, const ShaderLibrary&);

/// Moves the steps that feed nothing kept from plan.steps to plan.culled.
void cull(const Graph&, Plan&);

/// Fails when a surviving step reads what nothing has written, or nothing writes what is kept.
Result<void> check_contents(const Graph&, const Plan&);

/// Images of equal shape with disjoint lives share a slot.
void assign_memory(const Graph&, Plan&);

/// Every use waits for the previous one, except repeating the same read.
void place_barriers(const Graph&, Plan&);

}  // namespace strata
