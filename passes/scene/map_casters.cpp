#include "passes/scene/map_casters.h"

namespace strata {

glm::dmat4 to_clip(const ShadowView& view) {
    glm::dmat4 made = view.view_to_map;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 2; ++row) made[column][row] = 2 * made[column][row] - made[column][3];
    return made;
}

MapCastersPush casters_push(const ShadowView& view, const MapPart& part, const DrawList& casters) {
    const auto clip = [&](std::uint32_t column, std::uint32_t row) {
        return glm::vec2(glm::dvec2(column, row) * 2. / double(view.size) - 1.);
    };
    return {.to_clip = glm::mat4(to_clip(view)),
            .low = clip(part.columns.first, part.rows.first),
            .high = clip(part.columns.first + part.columns.count, part.rows.first + part.rows.count),
            .light = glm::vec3(0),
            .range = 0,
            .first = casters.first,
            .count = casters.count,
            .to = 0};
}

}  // namespace strata
