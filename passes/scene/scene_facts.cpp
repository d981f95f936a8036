#include "passes/scene/scene_facts.h"

#include "capture_format/frame/light.h"
#include "passes/scene/caster_hashes.h"
#include "passes/scene/fragment_bounds.h"
#include "passes/scene/frame_spectrum.h"
#include "passes/scene/light_features.h"
#include "passes/scene/light_list.h"
#include "passes/scene/readers.h"

namespace strata {

SceneFacts::SceneFacts(const Frame& frame) : frame_(&frame) {}
SceneFacts::~SceneFacts() = default;

const Features& SceneFacts::features() const {
    return features_.get([&] { return frame_features(*frame_); });
}

const DrawLists& SceneFacts::lists() const {
    return lists_.get([&] { return draw_lists(*frame_); });
}

std::span<const Light> SceneFacts::lights() const {
    return lights_.get([&] { return light_list(*frame_); });
}

const DrawBounds& SceneFacts::bounds() const {
    return bounds_.get([&] { return draw_bounds(*frame_); });
}

const std::vector<ShadowView>& SceneFacts::shadow_views(Allocation allocation) const {
    return views_[static_cast<std::size_t>(allocation)].get([&] {
        std::vector<BoundingSphere> casters;
        for (const std::uint32_t draw : lists().casters) casters.push_back(bounds().spheres[draw]);
        return strata::shadow_views(*frame_, {lights(), casters}, allocation);
    });
}

const Readers& SceneFacts::readers() const {
    return *readers_.get([&] { return std::make_unique<Readers>(*frame_, lists(), bounds()); });
}

DepthRange SceneFacts::transparent_depths() const {
    return transparent_depths_.get([&] { return depths_with_layers(*frame_, lists(), world_depths()); });
}

DepthRange SceneFacts::world_depths() const {
    return world_depths_.get([&] { return strata::world_depths(*frame_, lists()); });
}

float SceneFacts::farthest_depth_offset() const {
    return farthest_depth_offset_.get([&] { return strata::farthest_depth_offset(*frame_); });
}

const FragmentBounds& SceneFacts::fragment_bounds(Extent extent, std::uint32_t samples) const {
    const auto [found, is_new] = fragment_bounds_.try_emplace({extent.width, extent.height, samples});
    if (is_new) found->second = strata::fragment_bounds(*frame_, lists(), extent, samples);
    return found->second;
}

const MaterialUses& SceneFacts::material_uses(Surfaces surfaces) const {
    return material_uses_[static_cast<std::size_t>(surfaces)].get(
        [&] { return strata::material_uses(*frame_, lists(), surfaces); });
}

std::uint32_t SceneFacts::light_features() const {
    return light_features_.get([&] { return strata::light_features(*frame_, lights()); });
}

std::uint32_t SceneFacts::spectrum() const {
    return spectrum_.get([&] { return frame_spectrum(*frame_, lights(), bounds()); });
}

const std::vector<std::uint32_t>& SceneFacts::possible_spectra(std::uint32_t features) const {
    const auto [found, is_new] = possible_spectra_.try_emplace(features);
    if (is_new) found->second = strata::possible_spectra(*frame_, lights(), bounds(), features);
    return found->second;
}

std::uint64_t SceneFacts::light_iterations() const { return strata::light_iterations(lights()); }

std::uint32_t SceneFacts::highest_interface_layer() const {
    return highest_interface_layer_.get([&] { return strata::highest_interface_layer(*frame_, lists()); });
}

const std::vector<std::uint64_t>& SceneFacts::caster_hashes() const {
    return caster_hashes_.get([&] { return strata::caster_hashes(*frame_, lists().casters); });
}

std::size_t SceneFacts::derived() const {
    std::size_t made = fragment_bounds_.size() + possible_spectra_.size();
    for (const bool is_made :
         {features_.is_made(), lists_.is_made(), lights_.is_made(), bounds_.is_made(), views_[0].is_made(), views_[1].is_made(),
          transparent_depths_.is_made(), world_depths_.is_made(), farthest_depth_offset_.is_made(), material_uses_[0].is_made(),
          material_uses_[1].is_made(), light_features_.is_made(), spectrum_.is_made(), highest_interface_layer_.is_made(),
          caster_hashes_.is_made(), readers_.is_made()})
        made += is_made ? 1 : 0;
    return made;
}

}  // namespace strata
