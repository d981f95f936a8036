// Tiled lighting in double: every light of a tile's list at each of its samples. With its defaults nothing is left out that adds
// anything, and no list is asked for: the model is then every light at every sample. Lists are asked for where they change the
// picture: lights that are dropped, and blockers that darken whole tiles or nothing. Sample 0 of plain pixels stands for all.
#include <algorithm>
#include <map>

#include "passes/lighting/tiled/cull_scene.h"
#include "passes/reference/blockers.h"
#include "passes/reference/decoded.h"
#include "passes/reference/lights.h"
#include "passes/shadows/shadow_views.h"
#include "passes/technique.h"

namespace strata::lighting {
namespace {

constexpr double largest_half = 65504;

struct ModelLight {
    Light light;
    glm::dvec4 from{0};
    LightBlockers blockers;
    std::uint32_t visibility_layer = no_index;  ///< of sample 0
};

class TiledModel {
public:
    TiledModel(const StageInput& input, const TiledParams& params)
        : frame_(&input.frame),
          params_(params),
          normal_(&input.before.at("surface_normal")),
          color_(&input.before.at("surface_color")),
          material_(&input.before.at("surface_material")),
          visibility_(find(input, "visibility")),
          edges_(find(input, "edges")),
          scene_(cull_scene(input.frame)) {
        for (const Light& light : shadow_lights(input.frame))
            lights_.push_back({light, light_point(input.frame, light), light_blockers(input.frame, light)});
        std::uint32_t layer = 0;
        for (const std::uint32_t light : shadowed_lights(shadow_views(input.frame))) {
            lights_[light].visibility_layer = layer;
            layer += input.frame.view.samples;
        }
    }

    ReferenceImage light() {
        ReferenceImage light(normal_->width, normal_->height, normal_->layers);
        if (params_.shadows == shadows_inline) light.undecided.resize(light.texels.size());
        for (std::uint32_t y = 0; y < light.height; ++y)
            for (std::uint32_t x = 0; x < light.width; ++x)
                for (std::uint32_t sample = 0; sample < light.layers; ++sample) {
                    const std::uint32_t shaded = is_plain(x, y) ? 0 : sample;
                    const glm::dvec3 sum = glm::clamp(at(x, y, shaded), -largest_half, largest_half);
                    light.at(x, y, sample) = glm::dvec4(sum, 1);
                    if (!light.undecided.empty()) light.undecided[light.index(x, y, sample)] = is_in_penumbra(x, y, shaded);
                }
        return light;
    }

private:
    static const ReferenceImage* find(const StageInput& input, const char* name) {
        const auto found = input.before.find(name);
        return found == input.before.end() ? nullptr : &found->second;
    }

    bool is_plain(std::uint32_t x, std::uint32_t y) const { return edges_ && edges_->at(x, y).x == 0; }

    bool is_lit(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
        return normal_->at(x, y, sample).w > 0 && material_->at(x, y, sample).x != double(LightingModel::unlit);
    }

    /// A light filtered at the G-buffer's position instead of the depth image's differs where its shadow ends.
    bool is_in_penumbra(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
        if (!visibility_) return false;
        const auto near = [](std::uint32_t at, std::uint32_t i, std::uint32_t size) {
            return std::clamp(std::int64_t{at} + i - 1, std::int64_t{0}, std::int64_t{size} - 1);
        };
        for (const ModelLight& l : lights_) {
            if (l.visibility_layer == no_index) continue;
            const double here = visibility_->at(x, y, l.visibility_layer + sample).x;
            if (here > 0 && here < 1) return true;
            for (std::uint32_t i = 0; i < 9; ++i) {
                const auto u = static_cast<std::uint32_t>(near(x, i % 3, normal_->width));
                const auto v = static_cast<std::uint32_t>(near(y, i / 3, normal_->height));
                if (visibility_->at(u, v, l.visibility_layer + sample).x != here) return true;
            }
        }
        return false;
    }

    glm::dvec3 at(std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
        if (!is_lit(x, y, sample)) return glm::dvec3(0);
        const SurfacePoint p =
            decoded_surface(*frame_, {normal_->at(x, y, sample), color_->at(x, y, sample), material_->at(x, y, sample)}, x, y);
        const std::vector<bool>& listed = listed_in({x / tile_size, y / tile_size});
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < lights_.size(); ++i) {
            const ModelLight& l = lights_[i];
            if (!listed[i] || !reaches(l, p)) continue;
            const double visible =
                !visibility_ || l.visibility_layer == no_index ? 1 : visibility_->at(x, y, l.visibility_layer + sample).x;
            if (visible > 0) sum += visible * reflected(*frame_, p, l.light);
        }
        return sum;
    }

    bool reaches(const ModelLight& l, const SurfacePoint& p) const {
        return params_.blockers != blockers_per_pixel ||
               lets_through(l.blockers, l.from, off_surface(p.position, facing_normal(p)));
    }

    /// By light: whether the tile shades it.
    const std::vector<bool>& listed_in(glm::uvec2 tile) {
        const auto [found, is_new] = lists_.try_emplace({tile.x, tile.y});
        if (!is_new) return found->second;
        const bool lists_matter = params_.overflow == overflow_drop || params_.blockers == blockers_tile_only;
        found->second.assign(lights_.size(), !lists_matter);
        if (lists_matter)
            for (const ListedLight& listed : cull_tile(scene_, params_, tile, surfaces_of(tile)).lights)
                found->second[listed.light] = true;
        return found->second;
    }

    TileSurfaces surfaces_of(glm::uvec2 tile) const {
        TileSurfaces surfaces;
        for (std::uint32_t y = tile.y * tile_size; y < std::min((tile.y + 1) * tile_size, normal_->height); ++y)
            for (std::uint32_t x = tile.x * tile_size; x < std::min((tile.x + 1) * tile_size, normal_->width); ++x)
                for (std::uint32_t sample = 0; sample < (is_plain(x, y) ? 1 : normal_->layers); ++sample)
                    if (is_lit(x, y, sample)) surfaces.depths.push_back(float(normal_->at(x, y, sample).w));
        return surfaces;
    }

    const Frame* frame_;
    TiledParams params_;
    const ReferenceImage *normal_, *color_, *material_, *visibility_, *edges_;
    CullScene scene_;
    std::vector<ModelLight> lights_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<bool>> lists_;
};

}  // namespace

ImageSet tiled_model(const StageInput& input, const Settings& settings) {
    return {{"light", TiledModel(input, settings.as<TiledParams>()).light()}};
}

}  // namespace strata::lighting
