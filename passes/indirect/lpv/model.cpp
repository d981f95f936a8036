// Light propagation volumes in double, from docs/algorithms/lighting.md 5 and not from the shaders: virtual lights of reflective
// shadow maps, injected, propagated and gathered. The device stores fixed-point sums and a half-float image; here all is
// double, but for cells that are to hold half floats.
#include "passes/indirect/lpv/model.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "capture_format/frame/frame.h"
#include "capture_format/light_types.h"
#include "passes/indirect/lpv/apply/half_resolution_model.h"
#include "passes/indirect/lpv/injection/bounce_model.h"
#include "passes/indirect/lpv/injection/reflective_map_model.h"
#include "passes/indirect/lpv/occlusion/fuzzy_model.h"
#include "passes/indirect/lpv/occlusion/occlusion_model.h"
#include "passes/indirect/lpv/propagation/half_cells_model.h"
#include "passes/indirect/lpv/surfels/surfels_model.h"
#include "passes/reference/decoded.h"
#include "passes/reference/light_sets.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::indirect {
namespace in_double {
namespace {

bool adds_light(const Light& light) { return light.intensity.x > 0 || light.intensity.y > 0 || light.intensity.z > 0; }

bool is_axial(const Grid& grid, const LpvParams& params) {
    if (params.occlusion == occlusion_recorded) return grid.occlusion == VolumeOcclusion::axial;
    return params.occlusion == occlusion_axial || params.occlusion == occlusion_both;
}

bool is_fuzzy(const Grid& grid, const LpvParams& params) {
    if (params.occlusion == occlusion_recorded) return grid.occlusion == VolumeOcclusion::fuzzy_geometry;
    return params.occlusion == occlusion_fuzzy || params.occlusion == occlusion_both;
}

/// What the lights of a frame make its surfaces reflect.
class Sources {
public:
    Sources(const Frame& frame, std::span<const Grid> grids, const LpvParams& params)
        : maps_(frame, params.map_size, double(params.map_density)) {
        for (const Light& light : shining_lights(frame)) {
            if (!adds_light(light)) continue;
            if (!has_range(light.type)) {
                directional_.push_back(light);
            } else {
                const std::vector<VirtualLight> reflected = maps_.of_local(light, grids);
                local_.insert(local_.end(), reflected.begin(), reflected.end());
            }
        }
    }

    std::vector<VirtualLight> around(const Grid& grid) const {
        std::vector<VirtualLight> all;
        for (const Light& light : directional_) {
            const std::vector<VirtualLight> reflected = maps_.of_directional(light, grid);
            all.insert(all.end(), reflected.begin(), reflected.end());
        }
        all.insert(all.end(), local_.begin(), local_.end());
        return all;
    }

private:
    ReflectiveMaps maps_;
    std::vector<Light> directional_;
    std::vector<VirtualLight> local_;
};

/// What the light of a grid travels by.
struct Way {
    Links first, later;  ///< of the first step and of those after it
    InjectionRule injection;
    PropagationRule propagation;
    std::uint32_t iterations = 0;
    std::uint32_t storage = storage_float;
    bool shows_injected = true;
    bool knows_facing = false;
};

/// All that cells ever hold of the light that is injected; `halves` as which they store it.
Field brought(const Way& way, Field light, const HalfCells& halves) {
    for (Channel& channel : light) {
        const Channel shown = way.shows_injected ? channel : Channel(channel.size(), glm::dvec4(0));
        if (way.storage == storage_half) {
            channel = propagated_in_halves({way.first, way.later}, halves, {.injected = channel, .shown = shown}, way.propagation,
                                           way.iterations);
            continue;
        }
        if (way.iterations == 0) {
            channel = shown;
            continue;
        }
        // The sum over all steps is what is shown at first and what goes on from the first step.
        const Channel next =
            propagated(way.later, next_step(way.first, channel, way.propagation), way.propagation, way.iterations - 1);
        std::ranges::transform(shown, next, channel.begin(), std::plus{});
    }
    return light;
}

/// Light, and the same by the way that its sources face.
struct Brought {
    Field light, facing;
};
Brought brought(const Grid& grid, const Way& way, const std::vector<VirtualLight>& sources) {
    const Field direct = injected(grid, sources, way.injection);
    const HalfCells halves(direct);
    Brought result{.light = brought(way, direct, halves), .facing = {}};
    if (way.knows_facing) result.facing = brought(way, injected(grid, by_facing(sources), way.injection), halves);
    return result;
}

Field sum_of(Field light, const Field& more) {
    for (std::size_t channel = 0; channel < more.size(); ++channel)
        std::ranges::transform(light[channel], more[channel], light[channel].begin(), std::plus{});
    return light;
}

LitGrid lit(const Frame& frame, const Grid& grid, const Sources& sources, std::span<const Barrier> barriers,
            const LpvParams& params) {
    const std::span<const Barrier> in_the_way = is_axial(grid, params) ? barriers : std::span<const Barrier>();
    LitGrid result{.grid = grid};
    result.irradiance = params.irradiance;
    result.damping = double(params.damping);
    result.reading = double(params.reading);
    if (params.taps == taps_visible) result.tap_barriers = in_the_way;
    const bool asks_surfels = is_fuzzy(grid, params) || params.bounces > 1;
    const std::vector<Surfel> pieces = asks_surfels ? surfels(frame, grid) : std::vector<Surfel>();
    const Links by_blockers = links(grid, in_the_way);
    const Way way{.first = by_blockers,
                  .later = is_fuzzy(grid, params) ? with_surfels(grid, by_blockers, pieces) : by_blockers,
                  .injection = {.bias = double(params.injection), .barriers = in_the_way},
                  .propagation = {.propagation = params.propagation, .faces = params.faces, .lobes = params.lobes},
                  .iterations = params.iterations == 0 ? grid.iterations : params.iterations,
                  .storage = params.cell_storage,
                  .shows_injected = params.self_light != self_uninjected,
                  .knows_facing = params.self_light == self_facing};
    const std::vector<VirtualLight> reflecting = sources.around(grid);
    Brought first = brought(grid, way, reflecting);
    result.light = std::move(first.light);
    result.facing = std::move(first.facing);
    if (params.bounces < 2) return result;
    const Brought second = brought(grid, way, reflected(pieces, result));
    result.light = sum_of(result.light, second.light);
    if (way.knows_facing) result.facing = sum_of(result.facing, second.facing);
    if (way.storage != storage_half) return result;
    const HalfCells halves(injected(grid, reflecting, way.injection));
    for (Field* const field : {&result.light, &result.facing})
        for (Channel& channel : *field) channel = halves.summed(channel);
    return result;
}

}  // namespace

LitVolumes lit_volumes(const Frame& frame, const LpvParams& params) {
    LitVolumes volumes{.barriers = barriers(frame), .grids = {}};
    const std::vector<Grid> all = grids(frame, std::ldexp(1.0, int(params.cell_scale) - int(cells_recorded)));
    if (all.empty()) return volumes;
    const Sources sources(frame, all, params);
    for (const Grid& grid : all) volumes.grids.push_back(lit(frame, grid, sources, volumes.barriers, params));
    return volumes;
}

namespace {

/// Surfaces as receivers of light, by pixel and sample.
class Surfaces {
public:
    explicit Surfaces(const StageInput& input)
        : frame_(input.frame),
          normal_(input.before.at("surface_normal")),
          color_(input.before.at("surface_color")),
          material_(input.before.at("surface_material")) {}

    const ReferenceImage& normals() const { return normal_; }
    std::optional<Receiver> at(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
        if (normal_.at(x, y, sample).w <= 0) return std::nullopt;
        const SurfacePoint p =
            decoded_surface(frame_, {normal_.at(x, y, sample), color_.at(x, y, sample), material_.at(x, y, sample)}, x, y);
        return Receiver{frame_.view.origin + to_world_ * p.position, to_world_ * facing_normal(p)};
    }
    VisibleSurfaces first_samples() const {
        VisibleSurfaces seen{.width = normal_.width, .height = normal_.height, .receivers = {}, .depths = {}};
        for (std::uint32_t y = 0; y < normal_.height; ++y)
            for (std::uint32_t x = 0; x < normal_.width; ++x) {
                seen.receivers.push_back(at(x, y, 0));
                seen.depths.push_back(normal_.at(x, y, 0).w);
            }
        return seen;
    }

private:
    const Frame& frame_;
    const ReferenceImage &normal_, &color_, &material_;
    glm::dmat3 to_world_ = glm::transpose(frame_.view.to_view);
};

std::vector<HalfResolutionLight> at_half_resolution(std::span<const LitGrid> grids, const Surfaces& surfaces) {
    const VisibleSurfaces seen = surfaces.first_samples();
    std::vector<HalfResolutionLight> lights;
    for (const LitGrid& lit : grids) lights.emplace_back(lit, seen);
    return lights;
}

}  // namespace

ImageSet indirect_light(const StageInput& input, const LpvParams& params) {
    const Surfaces surfaces(input);
    const LitVolumes volumes = lit_volumes(input.frame, params);
    std::vector<HalfResolutionLight> halves;
    if (params.apply_resolution == resolution_half) halves = at_half_resolution(volumes.grids, surfaces);
    const ReferenceImage& normals = surfaces.normals();
    ReferenceImage indirect(normals.width, normals.height, normals.layers);
    if (volumes.grids.empty()) return {{"indirect", indirect}};  // no grid writes, and the image stays clear
    tbb::parallel_for(0u, normals.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < normals.width; ++x)
            for (std::uint32_t sample = 0; sample < normals.layers; ++sample) {
                const std::optional<Receiver> at = surfaces.at(x, y, sample);
                if (!at) continue;
                const auto light_of = [&](std::size_t i) {
                    const auto near = halves.empty() ? std::nullopt : halves[i].at(*at, {x, y});
                    return near ? *near : irradiance(volumes.grids[i], *at);
                };
                const glm::dvec3 light = blended(std::span<const LitGrid>(volumes.grids), at->position, light_of);
                indirect.at(x, y, sample) = glm::dvec4(light / std::numbers::pi, 1);
            }
    });
    return {{"indirect", indirect}};
}

}  // namespace in_double

ImageSet lpv_model(const StageInput&, const Settings&);

ImageSet lpv_model(const StageInput& input, const Settings& settings) {
    return in_double::indirect_light(input, settings.as<LpvParams>());
}

}  // namespace strata::indirect
