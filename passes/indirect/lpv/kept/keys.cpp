#include "passes/indirect/lpv/kept/keys.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/frame_images.h"
#include "passes/indirect/lpv/injection/injection.h"
#include "passes/indirect/lpv/propagation/propagation.h"
#include "passes/indirect/lpv/volumes.h"
#include "passes/scene/digest.h"
#include "passes/scene/light_blockers.h"
#include "passes/scene/scene_facts.h"
#include "passes/scene/view_space.h"

namespace strata::indirect {
namespace {

uvec2 words(std::uint64_t hash) { return {static_cast<std::uint32_t>(hash), static_cast<std::uint32_t>(hash >> 32)}; }

void add(Digest& digest, const LightEye& eye) { digest.add(eye.view.origin).add(eye.view.to_view); }

uvec2 lattice_key(const DeviceGrid& lit) {
    const LightGrid& grid = lit.grid;
    Digest digest;
    add(digest, lit.eye);
    digest.add(grid.cell).add(grid.cells).add(grid.is_local);
    // Middles of a cascade's cells round alike wherever it begins where their places are exact.
    int exponent = 0;
    const bool is_exact = !grid.is_local && std::frexp(grid.cell, &exponent) == .5;
    if (!is_exact) digest.add(grid.origin);
    return words(digest.value());
}

uvec2 place_key(const LpvParams& params, const DeviceGrid& grid) {
    Digest digest;
    add(digest, grid.eye);
    digest.add(grid.grid.origin).add(grid.grid.cell).add(grid.grid.cells).add(grid.has_links);
    digest.add(iterations(params, grid)).add(params.propagation).add(params.faces).add(params.cell_storage);
    digest.add(params.self_light).add(params.lobes);
    return words(digest.value());
}

uvec2 linked_key(uvec2 lattice, const LightGrid& grid, std::span<const uvec2> barriers) {
    Digest digest;
    digest.add(lattice).add(first_cell(grid));
    for (const uvec2& barrier : barriers) digest.add(barrier);
    return words(digest.value());
}

void add(Digest& digest, const Light& light) {
    digest.add(light.type).add(light.position).add(light.direction).add(light.axis_u).add(light.intensity).add(light.range);
    digest.add(light.window).add(light.source_radius).add(light.half_extent).add(light.inner_angle).add(light.outer_angle);
    for (const ClipPlane& plane : light.clip_planes) digest.add(plane.normal).add(plane.distance);
    digest.add_all(light.blockers).add_all(light.portals);
}

/// Whether a light of some range may show it.
bool is_reached(const Frame& frame, const Light& light, const BoundingSphere& caster) {
    if (!has_range(light.type)) return true;
    const double away = glm::distance(in_view_space(frame.view, light.position), caster.center);
    return away - caster.radius <= double(light.range) + 1e-3;  // the eye's place rounds spheres
}

/// A light and what its maps show.
void add_injected(Digest& digest, const SceneFacts& facts, const Light& light) {
    add(digest, light);
    const std::vector<std::uint32_t>& casters = facts.lists().casters;
    for (std::size_t i = 0; i < casters.size(); ++i)
        if (is_reached(facts.frame(), light, facts.bounds().spheres[casters[i]])) digest.add(facts.caster_hashes()[i]);
}

}  // namespace

/// The origin of a cascade is a whole number of cells.
glm::i64vec3 first_cell(const LightGrid& grid) {
    return grid.is_local ? glm::i64vec3(0) : glm::i64vec3(glm::round(grid.origin / grid.cell));
}

std::vector<uvec2> barrier_identities(const Frame& frame) {
    std::vector<uvec2> identities;
    for (const Blocker& blocker : frame.blockers) {
        Digest digest;
        digest.add(blocker.center).add(blocker.u).add(blocker.v).add(blocker.half_u).add(blocker.half_v).add(blocker.one_sided);
        identities.push_back(words(digest.value()));
    }
    const std::vector<BlockerPortalRecord> records = portal_records(frame);
    std::vector<Portal> portals = frame.portals;
    std::ranges::stable_sort(portals, {}, &Portal::blocker);  // as portal_records() has them
    for (std::size_t i = 0; i < records.size(); ++i) {
        const Portal& portal = portals[i];
        Digest digest;
        digest.add(portal.center).add(portal.u).add(portal.v).add(portal.half_u).add(portal.half_v).add(portal.blocker);
        digest.add(records[i].half_extent);  // a portal that begins beside this one makes it wider
        identities.push_back(words(digest.value()));
    }
    return identities;
}

GridKeys keys_of(const FrameImages& frame, const LpvParams& params, const DeviceGrid& grid) {
    const std::vector<uvec2> barriers = barrier_identities(*frame.recorded);
    GridKeys keys{.lattice = lattice_key(grid)};
    keys.place = place_key(params, grid);
    if (grid.has_links) keys.linked = linked_key(keys.lattice, grid.grid, barriers);
    Digest digest;
    digest.add(keys.place).add(params.map_size).add(params.map_density).add(params.injection);
    for (const uvec2& barrier : barriers) digest.add(barrier);
    const std::vector<LightGrid> all = light_grids(*frame.recorded, cell_scale(params));
    for (const Light& light : frame.facts->lights()) {
        if (!injects(light, grid.grid)) continue;
        add_injected(digest, *frame.facts, light);
        if (has_range(light.type)) digest.add(texels_a_side(light, all, map_texels(params)));
    }
    keys.light = words(digest.value());
    return keys;
}

}  // namespace strata::indirect
