// Judges a visible set.
#include "passes/culling/judge.h"

#include "passes/reference/fragments.h"
#include "passes/stage_input.h"

namespace strata {

std::vector<Metric> culling_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const ReferenceImage& drawn = result.at("visible");
    const ReferenceImage& exact = truth.at("visible");
    const std::size_t draws = opaque_draws(input.frame).size();
    double hidden = 0, needless = 0, drawn_count = 0, visible_count = 0;
    for (std::size_t i = 0; i < draws; ++i) {
        const bool is_drawn = drawn.texels[i].x != 0, is_visible = exact.texels[i].x != 0;
        drawn_count += is_drawn;
        visible_count += is_visible;
        const bool decided = exact.undecided.empty() || !exact.undecided[i];
        needless += is_drawn && !is_visible && decided;
        hidden += !is_drawn && is_visible && decided;
    }
    return {{"wrongly hidden", "draws", hidden},
            {"needlessly drawn", "draws", needless},
            {"drawn", "draws", drawn_count},
            {"visible", "draws", visible_count}};
}

}  // namespace strata
