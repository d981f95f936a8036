#include "passes/scene/draw_lists.h"

#include <algorithm>
#include <cstddef>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"

namespace strata {

DrawLists draw_lists(const Frame& frame) {
    DrawLists lists;
    std::uint32_t index = 0;
    for (const Draw& draw : frame.draws) {
        if (is_transparent(frame.materials[draw.material].alpha_mode)) {
            lists.transparent.push_back(index);
        } else {
            lists.opaque.push_back(index);
            if (draw.casts_shadow) lists.casters.push_back(index);
        }
        ++index;
    }
    for (std::size_t emitter = 0; emitter < frame.emitters.size(); ++emitter) lists.transparent.push_back(index++);
    return lists;
}

std::uint32_t interface_layer(const Frame& frame, std::uint32_t index) {
    const std::size_t draws = frame.draws.size();
    return index < draws ? frame.draws[index].layer : frame.emitters[index - draws].layer;
}

bool shows_no_backs(const Frame& frame, std::span<const std::uint32_t> indices) {
    return std::ranges::all_of(indices, [&](std::uint32_t index) {
        return index < frame.draws.size() && !frame.materials[frame.draws[index].material].double_sided;
    });
}

std::uint32_t triangles_drawn(const Frame& frame, std::uint32_t index) {
    const std::size_t draws = frame.draws.size();
    const std::size_t triangles = index < draws ? frame.meshes[frame.draws[index].mesh].indices.size() / 3
                                                : 2 * frame.emitters[index - draws].particles.size();
    return static_cast<std::uint32_t>(triangles);
}

std::uint32_t highest_interface_layer(const Frame& frame, const DrawLists& lists) {
    std::uint32_t highest = 0;
    for (const std::uint32_t index : lists.transparent) highest = std::max(highest, interface_layer(frame, index));
    return highest;
}

}  // namespace strata
