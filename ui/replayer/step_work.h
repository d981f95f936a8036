// What a step of a plan does, in words.
#pragma once

#include <string>

#include "passes/graph/plan.h"

namespace strata::ui {

/// "compute, 10 x 6 x 1 groups", "draws 12 into 4 layers at once", and what is fixed in its shader.
std::string work_text(const PlannedStep&);
/// As much of it as a narrow column has room for: "60 groups", "12 draws".
std::string short_work(const PlannedStep&);
/// How many draws it has at most.
std::size_t draws_of(const PlannedStep&);

}  // namespace strata::ui
