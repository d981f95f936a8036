#include "tests/1_capture/without_memory/two_frames.h"

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/texture.h"
#include "tests/1_capture/sample_frames.h"

namespace strata {
namespace {

/// Triangles that each lie at one depth, on few rays from the origin, as those of a deep image.
Mesh samples() {
    Mesh mesh{.name = "samples"};
    for (std::uint32_t i = 0; i < 400; ++i) {
        const double z = 1 + i % 7 * .25;
        for (const auto& [x, y] : {std::pair{0u, 0u}, {1u, 0u}, {0u, 1u}}) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.emplace_back(float((i % 20 + x) * .1 * z), float((i / 20 + y) * .1 * z), float(z));
        }
    }
    return mesh;
}

Texture slope() {
    Texture texture{.name = "slope", .width = 64, .height = 64};
    for (std::uint32_t i = 0; i < 4 * 64 * 64; ++i) texture.texels.push_back(static_cast<std::byte>(i / 97));
    return texture;
}

}  // namespace

std::array<Frame, 2> two_frames() {
    Frame first = rich_frame();
    first.textures.push_back(slope());
    first.meshes.push_back(samples());
    Frame second = first;
    second.index = first.index + 1;
    second.draws[1].to_world[3].x += 1;
    return {first, second};
}

}  // namespace strata
