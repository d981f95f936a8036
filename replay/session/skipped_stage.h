// A stage that a frame was replayed without.
#pragma once

#include <string>

#include "passes/stage.h"

namespace strata {

struct SkippedStage {
    Stage stage;
    std::string reason;
};

}  // namespace strata
