#include "passes/indirect/lpv/tight_volumes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "passes/scene/scene_facts.h"

namespace strata::indirect {
namespace {

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
};

/// Around the boxes of all opaque draws, world.
Box around_opaque_draws(const SceneFacts& facts) {
    Box all;
    for (const std::uint32_t draw : facts.lists().opaque) {
        const Draw& recorded = facts.frame().draws[draw];
        const BoundingBox& box = facts.bounds().boxes[recorded.mesh];
        for (std::uint32_t corner = 0; corner < 8; ++corner) {
            const glm::dvec3 share(corner & 1, corner >> 1 & 1, corner >> 2);
            const glm::dvec3 at(recorded.to_world * glm::dvec4(glm::mix(box.low, box.high, share), 1));
            all.low = glm::min(all.low, at), all.high = glm::max(all.high, at);
        }
    }
    return all;
}

}  // namespace

std::vector<std::string> notes_on_tight_volumes(const SceneFacts& facts, std::span<const LightGrid> grids) {
    std::vector<std::string> notes;
    const Box scene = around_opaque_draws(facts);
    for (std::size_t i = 0; i < grids.size(); ++i) {
        if (!grids[i].is_local) continue;
        const glm::dvec3 low = grids[i].origin, high = low + grids[i].cell * glm::dvec3(grids[i].cells);
        std::vector<std::string> sides;
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            if (std::abs(scene.low[axis] - low[axis]) < grids[i].cell / 2) sides.push_back(fmt::format("-{}", "xyz"[axis]));
            if (std::abs(scene.high[axis] - high[axis]) < grids[i].cell / 2) sides.push_back(fmt::format("+{}", "xyz"[axis]));
        }
        if (sides.empty()) continue;
        notes.push_back(
            fmt::format("light grid {}: surfaces lie within half a cell of its border ({}), where a grid fades to nothing, and "
                        "take little or no "
                        "light; record a volume that is a cell ({:.3g} m) larger than its room on each side",
                        i, fmt::join(sides, ", "), grids[i].cell));
    }
    return notes;
}

}  // namespace strata::indirect
