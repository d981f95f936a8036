// The exact visible set.
#include "passes/culling/truth.h"

#include <unordered_map>

#include "capture_format/frame/no_index.h"
#include "passes/culling/visible_image.h"
#include "passes/reference/fragments.h"
#include "passes/stage_input.h"

namespace strata {

ImageSet culling_truth(const StageInput& input) {
    const std::vector<std::uint32_t> draws = opaque_draws(input.frame);
    std::unordered_map<std::uint32_t, std::size_t> place;
    for (std::size_t i = 0; i < draws.size(); ++i) place[draws[i]] = i;
    ReferenceImage visible(visible_width, visible_rows(draws.size()), 1, glm::dvec4(0, 0, 0, 1));
    visible.undecided.assign(visible.texels.size(), false);
    const VisiblePoints points = visible_points(input.frame, draws);
    for (const RasterPoint& point : points.points) {
        if (point.draw == no_index) continue;
        const std::size_t i = place.at(point.draw);
        // One sample that surely shows the draw decides; until then it hangs on rounding.
        visible.undecided[i] = point.undecided && (visible.texels[i].x == 0 || visible.undecided[i]);
        visible.texels[i].x = 1;
    }
    for (const RasterPoint& rival : points.rivals)
        if (rival.draw != no_index && visible.texels[place.at(rival.draw)].x == 0) visible.undecided[place.at(rival.draw)] = true;
    return {{"visible", visible}};
}

}  // namespace strata
