#include "tests/support/chessboard.h"

#include <cstring>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/texture.h"

namespace strata {

void paint_chessboard(Frame& frame, float cutoff) {
    const float texels[] = {1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, .5f};
    Texture& board = frame.textures.emplace_back(Texture{.format = TextureFormat::rgba32f, .width = 2, .height = 2, .mips = 2});
    board.texels.resize(sizeof texels);
    std::memcpy(board.texels.data(), texels, sizeof texels);
    for (const glm::vec3& corner : frame.meshes[0].positions) frame.meshes[0].uv0.push_back(32.f * glm::vec2(corner));
    frame.materials[0].base_color_texture.texture = 0;
    frame.materials[0].mask_cutoff = cutoff;
}

}  // namespace strata
