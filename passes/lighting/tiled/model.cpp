// Tiled lighting in double: every light of a tile's list at each of its samples. With its defaults nothing is left out that adds
// anything, and no list is asked for: the model is then every light at every sample. Lists are asked for where they change the
// picture: lights that are dropped, and blockers that darken whole tiles or nothing.
#include <algorithm>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"
#include "passes/lighting/every_light.h"
#include "passes/lighting/tiled/cull_scene.h"
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::lighting {
namespace {

TileSurfaces surfaces_of(const StageInput& input, glm::uvec2 tile) {
    const ReferenceImage &normal = input.before.at("surface_normal"), &material = input.before.at("surface_material");
    const glm::uvec2 first = tile * tile_size, end = glm::min(first + tile_size, glm::uvec2(normal.width, normal.height));
    TileSurfaces surfaces;
    for (std::uint32_t y = first.y; y < end.y; ++y)
        for (std::uint32_t x = first.x; x < end.x; ++x) {
            const std::uint32_t samples = is_plain_pixel(input, x, y) ? 1 : normal.layers;
            for (std::uint32_t sample = 0; sample < samples; ++sample) {
                const double z = normal.at(x, y, sample).w;
                const bool is_unlit = material.at(x, y, sample).x == double(LightingModel::unlit);
                if (z > 0 && !is_unlit) surfaces.depths.push_back(float(z));
            }
        }
    return surfaces;
}

/// Which lights the tile of a pixel shades.
class ListsOfModel {
public:
    ListsOfModel(const StageInput& input, const TiledParams& params) {
        const CullScene scene = cull_scene(input.frame);
        const ReferenceImage& normal = input.before.at("surface_normal");
        const glm::uvec2 tiles = (glm::uvec2(normal.width, normal.height) + tile_size - 1u) / tile_size;
        across_ = tiles.x;
        listed_.assign(std::size_t{tiles.x} * tiles.y, std::vector<bool>(scene.lights.size()));
        for (std::uint32_t i = 0; i < listed_.size(); ++i) {
            const glm::uvec2 tile(i % across_, i / across_);
            for (const ListedLight& listed : cull_tile(scene, params, tile, surfaces_of(input, tile)).lights)
                listed_[i][listed.light] = true;
        }
    }

    bool operator()(glm::uvec2 pixel, std::size_t light) const {
        const glm::uvec2 tile = pixel / tile_size;
        return listed_[std::size_t{tile.y} * across_ + tile.x][light];
    }

private:
    std::uint32_t across_ = 0;
    std::vector<std::vector<bool>> listed_;  ///< by tile and light
};

LightFilter filter_of(const StageInput& input, const TiledParams& params) {
    LightFilter filter{.asks_blockers = params.blockers == blockers_per_pixel};
    const bool lists_matter = params.overflow == overflow_drop || params.blockers == blockers_tile_only;
    if (lists_matter) filter.lists = ListsOfModel(input, params);
    return filter;
}

bool is_in_penumbra(const ReferenceImage& visibility, std::uint32_t x, std::uint32_t y, std::uint32_t layer) {
    const double here = visibility.at(x, y, layer).x;
    if (here > 0 && here < 1) return true;
    for (std::uint32_t v = std::max(y, 1u) - 1; v < std::min(y + 2, visibility.height); ++v)
        for (std::uint32_t u = std::max(x, 1u) - 1; u < std::min(x + 2, visibility.width); ++u)
            if (visibility.at(u, v, layer).x != here) return true;
    return false;
}

/// By texel: a light filtered at the G-buffer's position instead of the depth image's differs where its shadow ends.
std::vector<bool> penumbrae(const StageInput& input, const ReferenceImage& light) {
    std::vector<bool> found(light.texels.size());
    const auto visibility = input.before.find("visibility");
    if (visibility == input.before.end()) return found;
    for (std::uint32_t y = 0; y < light.height; ++y)
        for (std::uint32_t x = 0; x < light.width; ++x)
            for (std::uint32_t sample = 0; sample < light.layers; ++sample) {
                std::uint32_t layer = is_plain_pixel(input, x, y) ? 0 : sample;
                for (; layer < visibility->second.layers; layer += light.layers)
                    if (is_in_penumbra(visibility->second, x, y, layer)) found[light.index(x, y, sample)] = true;
            }
    return found;
}

}  // namespace

ImageSet tiled_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<TiledParams>();
    ImageSet images = light_of_shaded_samples(input, filter_of(input, params));
    ReferenceImage& light = images.at("light");
    if (params.shadows == shadows_inline) light.undecided = penumbrae(input, light);
    return images;
}

}  // namespace strata::lighting
