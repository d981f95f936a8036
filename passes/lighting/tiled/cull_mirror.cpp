#include "passes/lighting/tiled/cull_mirror.h"

#include <algorithm>
#include <bit>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/lighting/tiled/tiled.shared.h"
#include "passes/shaders/light_features.shared.h"

namespace strata::lighting {
namespace {

std::uint32_t low_bits(std::uint32_t n) { return n >= 32 ? 0xffffffffu : (1u << n) - 1; }

template <typename Function>
void for_each_bit(std::uint32_t mask, Function&& function) {
    for (; mask != 0; mask &= mask - 1) function(static_cast<std::uint32_t>(std::countr_zero(mask)));
}

glm::vec4 light_point(const LightRecord& light) {
    const bool is_placed = has_range(static_cast<LightType>(light.type));
    return is_placed ? glm::vec4(light.position, 1) : glm::vec4(-light.direction, 0);
}

/// A light with a slot, and what is known of its blockers and portals.
struct Slot {
    std::uint32_t light = 0;
    std::uint32_t portals_full = 0, portals_part = 0, blockers_part = 0;
    bool killed = false;
};

struct Pair {
    Slot* slot;
    std::uint32_t local;
};

class Tile {
public:
    Tile(const CullScene& scene, const TiledParams& params, std::vector<Cell<float>> cells)
        : scene_(&scene), params_(&params), cells_(std::move(cells)) {}

    /// P1: up to 64 lights from `cursor` on. The lights beyond are for the next batch; where they are dropped, they are counted.
    std::vector<Slot> collect(MirroredTile& result) {
        std::vector<Slot> slots;
        const bool drops = params_->overflow == overflow_drop;
        for (; cursor_ < scene_->lights.size(); ++cursor_) {
            if (!touches(scene_->lights[cursor_], 1)) {
                result.undecided += touches(scene_->lights[cursor_], 2);
                continue;
            }
            result.undecided += !touches(scene_->lights[cursor_], .25f);
            if (slots.size() == most_tile_lights) {
                result.overflow |= overflow_lights;
                if (!drops) return slots;
                ++result.touching;
                continue;
            }
            slots.push_back(slot_of(cursor_));
            ++result.touching;
        }
        return slots;
    }

    /// P2 to P5.
    void classify_pairs(std::vector<Slot>& slots, MirroredTile& result) const {
        const auto portals = pairs(slots, &Slot::portals_part);
        result.portal_pairs = std::max(result.portal_pairs, portals.all);
        if (portals.all > most_tile_pairs) result.overflow |= overflow_portal_pairs;
        for (const Pair& pair : portals.stored) classify_portal(pair, result);
        for (Slot& slot : slots) slot.blockers_part = blockers_left(slot);
        const auto blockers = pairs(slots, &Slot::blockers_part);
        result.blocker_pairs = std::max(result.blocker_pairs, blockers.all);
        if (blockers.all > most_tile_pairs) result.overflow |= overflow_blocker_pairs;
        for (const Pair& pair : blockers.stored) classify_blocker(pair, result);
    }

    /// P6.
    void keep(const std::vector<Slot>& slots, MirroredTile& result) const {
        const bool per_pixel = params_->blockers == blockers_per_pixel;
        for (const Slot& slot : slots) {
            if (slot.killed) {
                ++result.killed;
                continue;
            }
            const ListedLight listed{slot.light, per_pixel ? slot.blockers_part : 0, per_pixel ? slot.portals_part : 0};
            result.lights.push_back(listed);
            result.spectrum |= features_here(listed);
        }
    }

private:
    struct Pairs {
        std::vector<Pair> stored;
        std::uint32_t all = 0;
    };

    bool touches(const LightRecord& light, float slack) const {
        return std::ranges::any_of(cells_, [&](const Cell<float>& cell) {
            return light_touches({light, scene_->clip_planes, slack * cell_slack(light, cell)}, cell);
        });
    }

    Slot slot_of(std::uint32_t index) const {
        const LightRecord& light = scene_->lights[index];
        if (params_->blockers == blockers_off) return {.light = index};
        return {.light = index, .portals_part = low_bits(light.portals), .blockers_part = low_bits(light.blockers)};
    }

    static Pairs pairs(std::vector<Slot>& slots, std::uint32_t Slot::*mask) {
        Pairs result;
        for (Slot& slot : slots)
            for_each_bit(slot.*mask, [&](std::uint32_t local) {
                if (result.all++ < most_tile_pairs) result.stored.push_back({&slot, local});
            });
        return result;
    }

    Reach reach(const BlockerRecord& rectangle, const LightRecord& light) const {
        const Reach near = classify(rectangle, light_point(light), cells_.front());
        if (cells_.size() == 1) return near;
        return near == classify(rectangle, light_point(light), cells_.back()) ? near : Reach::partial;
    }

    void classify_portal(const Pair& pair, MirroredTile& result) const {
        const LightRecord& light = scene_->lights[pair.slot->light];
        const BlockerPortalRecord& portal = scene_->blocker_portals[light.first_portal + pair.local];
        const Reach r = reach(portal_rectangle(scene_->blockers[portal.blocker], portal), light);
        ++result.portal_classes[static_cast<std::size_t>(r)];
        if (r == Reach::full) pair.slot->portals_full |= 1u << pair.local;
        if (r != Reach::partial) pair.slot->portals_part &= ~(1u << pair.local);
    }

    const LightBlockerRecord& use(const LightRecord& light, std::uint32_t local) const {
        return scene_->light_blockers[light.first_blocker + local];
    }

    std::uint32_t blockers_left(const Slot& slot) const {
        const LightRecord& light = scene_->lights[slot.light];
        std::uint32_t left = slot.blockers_part;
        for_each_bit(slot.blockers_part, [&](std::uint32_t local) {
            if ((use(light, local).portals & slot.portals_full) != 0) left &= ~(1u << local);
        });
        return left;
    }

    void classify_blocker(const Pair& pair, MirroredTile& result) const {
        const LightRecord& light = scene_->lights[pair.slot->light];
        const LightBlockerRecord& blocker = use(light, pair.local);
        const Reach r = reach(scene_->blockers[blocker.blocker], light);
        ++result.blocker_classes[static_cast<std::size_t>(r)];
        if (r == Reach::none) pair.slot->blockers_part &= ~(1u << pair.local);
        if (r == Reach::full && (blocker.portals & pair.slot->portals_part) == 0) pair.slot->killed = true;
    }

    std::uint32_t features_here(const ListedLight& listed) const {
        const LightRecord& light = scene_->lights[listed.light];
        std::uint32_t here =
            light.features & ~(feature_blockers | feature_portals | feature_shadows | feature_soft_shadows | feature_clip_planes);
        if (light.visibility_layer != no_index) here |= (light.features | feature_shadows) & scene_->shadow_features;
        if (listed.blockers != 0) here |= feature_blockers;
        for_each_bit(listed.blockers, [&](std::uint32_t local) {
            if ((use(light, local).portals & listed.portals) != 0) here |= feature_portals;
        });
        const bool is_cut = std::ranges::any_of(cells_, [&](const Cell<float>& cell) {
            return is_straddled({light, scene_->clip_planes, cell_slack(light, cell)}, cell);
        });
        return is_cut ? here | (light.features & feature_clip_planes) : here;
    }

    const CullScene* scene_;
    const TiledParams* params_;
    std::vector<Cell<float>> cells_;
    std::uint32_t cursor_ = 0;
};

}  // namespace

std::vector<Cell<float>> cells_of_tile(const ViewRecord& view, const TiledParams& params, glm::uvec2 tile,
                                       std::span<const float> depths) {
    if (depths.empty()) return {};
    const auto [nearest, farthest] = std::ranges::minmax(depths);
    const float middle = .5f * (nearest + farthest);
    float near_end = 0, far_begin = farthest;
    bool two = false;
    for (const float z : depths) {
        if (z <= middle) {
            near_end = std::max(near_end, z);
        } else {
            far_begin = std::min(far_begin, z);
            two = params.half_z != 0;
        }
    }
    if (!two) return {tile_cell(view, tile, tile_size, {nearest, farthest})};
    return {tile_cell(view, tile, tile_size, {nearest, near_end}), tile_cell(view, tile, tile_size, {far_begin, farthest})};
}

MirroredTile cull_tile(const CullScene& scene, const TiledParams& params, glm::uvec2 tile, const TileSurfaces& surfaces) {
    MirroredTile result;
    std::vector<Cell<float>> cells = cells_of_tile(scene.view, params, tile, surfaces.depths);
    if (cells.empty()) return result;
    result.empty = false;
    result.spectrum = surfaces.models;
    Tile culled(scene, params, std::move(cells));
    for (std::uint32_t batch = 0;; ++batch) {
        std::vector<Slot> slots = culled.collect(result);
        if (slots.empty()) return result;
        result.records = batch + 1;
        if (batch > 0) result.overflow |= overflow_lights;
        if (params.classify != 0 && params.blockers != blockers_off) culled.classify_pairs(slots, result);
        culled.keep(slots, result);
    }
}

}  // namespace strata::lighting
