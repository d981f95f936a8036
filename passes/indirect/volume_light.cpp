#include "passes/indirect/volume_light.h"

#include <memory>
#include <numbers>
#include <vector>

#include "capture_format/frame/frame.h"
#include "passes/indirect/light_grid.shared.h"
#include "passes/indirect/reading_model.h"
#include "passes/stage_input.h"

namespace strata::indirect {
namespace {

using in_double::Barrier, in_double::LitGrid;

/// The grids of an image volume_light, as light_grid.shared.h lays them out. Macro-cells are not read: all blockers are asked.
class Volumes {
public:
    Volumes(const Frame& frame, const ReferenceImage& image) : view_(frame.view), barriers_(in_double::barriers(frame)) {
        const auto count = static_cast<std::size_t>(image.texels[2].z);
        std::size_t first_cell = records_per_grid * count;
        for (std::size_t i = 0; i < count; ++i) {
            grids_.push_back(read(image, i, first_cell));
            const std::size_t cells = cell_count(grids_.back().grid);
            first_cell += grids_.back().facing[0].empty() ? cells : 2 * cells;
        }
    }
    Volumes(const Volumes&) = delete;  // grids refer to the barriers
    Volumes& operator=(const Volumes&) = delete;

    /// Irradiance over pi. View space.
    glm::dvec3 at(const glm::dvec3& position, const glm::dvec3& normal) const {
        const glm::dmat3 to_world = glm::transpose(view_.to_view);
        return blended_irradiance(grids_, {view_.origin + to_world * position, to_world * normal}) / std::numbers::pi;
    }

private:
    LitGrid read(const ReferenceImage& image, std::size_t number, std::size_t first_cell) const {
        const auto texel = [&](std::size_t record, std::size_t i) { return image.texels[texels_per_record * record + i]; };
        const auto of_grid = [&](std::size_t i) { return texel(records_per_grid * number, i); };
        const glm::dvec4 corner = of_grid(0), size = of_grid(1), rule = of_grid(2), read = of_grid(3);
        LitGrid lit{.grid = {.cells = glm::uvec3(size),
                             .cell_size = corner.w,
                             .origin = view_.origin + glm::dvec3(corner),
                             .fade_cells = size.w / corner.w},
                    .light = {},
                    .reading = read.x};
        lit.irradiance = static_cast<std::uint32_t>(rule.y);
        if (rule.x != 0) lit.tap_barriers = barriers_;
        const std::size_t cells = cell_count(lit.grid);
        for (std::size_t channel = 0; channel < lit.light.size(); ++channel)
            for (std::size_t cell = 0; cell < cells; ++cell) {
                lit.light[channel].push_back(texel(first_cell + cell, channel));
                if (read.y != 0) lit.facing[channel].push_back(texel(first_cell + cells + cell, channel));
            }
        return lit;
    }

    View view_;
    std::vector<Barrier> barriers_;
    std::vector<LitGrid> grids_;
};

}  // namespace

LightAround volume_light(const Frame& frame, const ImageSet& before) {
    const auto found = before.find("volume_light");
    if (found == before.end()) return {};
    const auto volumes = std::make_shared<const Volumes>(frame, found->second);
    return [volumes](const glm::dvec3& position, const glm::dvec3& normal) { return volumes->at(position, normal); };
}

}  // namespace strata::indirect
