// Finds stages in the table that passes/techniques.cmake writes from the list in passes/CMakeLists.txt. A stage that is unwanted
// is left out with its techniques' own passes; what another stage's technique does at this point of the frame still happens.
#include "passes/stages.h"

#include <algorithm>
#include <cstddef>

#include "capture_format/nearest_name.h"

namespace strata {

std::span<const StageInfo> stages() {
    static const std::vector<StageInfo> kept = [] {
        std::vector<StageInfo> table = stage_table();
        for (std::size_t i = 0; i < table.size(); ++i) {
            table[i].stage = static_cast<Stage>(i);
            table[i].name = stage_names[i];
        }
        return table;
    }();
    return kept;
}

const StageInfo& info(Stage stage) { return stages()[static_cast<std::size_t>(stage)]; }

std::optional<Stage> find_stage(std::string_view name) {
    for (const StageInfo& stage : stages())
        if (stage.name == name || std::ranges::count(stage.aliases, name) > 0) return stage.stage;
    return std::nullopt;
}

Result<Stage> stage_called(std::string_view wanted) {
    if (const auto stage = find_stage(wanted)) return *stage;
    return fail(Fault::usage, "stage.unknown", "there is no stage '{stage}'{suggestion}", wanted,
                did_you_mean(wanted, stage_names));
}

}  // namespace strata
