// Finds stages in the table that passes/techniques.cmake writes from the list in passes/CMakeLists.txt. A stage that is unwanted
// is left out with its techniques' own acts; what another stage's technique does at this point of the frame still happens.
#include "passes/stages.h"

#include <cassert>

namespace strata {

const StageInfo& info(Stage stage) {
    const StageInfo& found = stages()[static_cast<std::size_t>(stage)];
    assert(found.stage == stage && "a stage says which it is in its own folder");
    return found;
}

std::optional<Stage> find_stage(std::string_view name) {
    for (const StageInfo& stage : stages())
        if (stage.name == name) return stage.stage;
    return std::nullopt;
}

}  // namespace strata
