// Light propagation volumes in double, from docs/algorithms/lighting.md 5 and not from the shaders: virtual lights of reflective
// shadow maps, injected, propagated and gathered. The device stores fixed-point sums and half floats; here all is double.
#include "passes/indirect/lpv/model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include "passes/indirect/lpv/injection/reflective_map_model.h"
#include "passes/indirect/lpv/occlusion/occlusion_model.h"
#include "passes/reference/decoded.h"
#include "passes/reference/light_sets.h"

namespace strata::indirect {
namespace in_double {
namespace {

bool adds_light(const Light& light) { return light.intensity.x > 0 || light.intensity.y > 0 || light.intensity.z > 0; }

bool is_axial(const Grid& grid, const LpvParams& params) {
    if (params.occlusion == occlusion_recorded) return grid.occlusion == VolumeOcclusion::axial;
    return params.occlusion == occlusion_axial;
}

/// What the lights of a frame make its surfaces reflect.
class Sources {
public:
    Sources(const Frame& frame, const LpvParams& params) : maps_(frame, params.map_size) {
        for (const Light& light : shining_lights(frame)) {
            if (!adds_light(light)) continue;
            if (light.type == LightType::directional) {
                directional_.push_back(light);
            } else {
                const std::vector<VirtualLight> reflected = maps_.of_local(light);
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

LitGrid lit(const Grid& grid, const Sources& sources, std::span<const Barrier> barriers, const LpvParams& params) {
    const std::span<const Barrier> in_the_way = is_axial(grid, params) ? barriers : std::span<const Barrier>();
    LitGrid result{.grid = grid};
    result.irradiance = params.irradiance;
    if (params.taps == taps_visible) result.tap_barriers = in_the_way;
    result.light = injected(grid, sources.around(grid), {.bias = double(params.injection), .barriers = in_the_way});
    const Links open = links(grid, in_the_way);
    const std::uint32_t iterations = params.iterations == 0 ? grid.iterations : params.iterations;
    const PropagationRule rule{.propagation = params.propagation, .faces = params.faces};
    for (Channel& channel : result.light) channel = propagated(open, channel, rule, iterations);
    return result;
}

}  // namespace

LitVolumes lit_volumes(const Frame& frame, const LpvParams& params) {
    LitVolumes volumes{.barriers = barriers(frame), .grids = {}};
    const std::vector<Grid> all = grids(frame, std::ldexp(1.0, int(params.cell_scale) - int(cells_recorded)));
    if (all.empty()) return volumes;
    const Sources sources(frame, params);
    for (const Grid& grid : all) volumes.grids.push_back(lit(grid, sources, volumes.barriers, params));
    return volumes;
}

ImageSet indirect_light(const StageInput& input, const LpvParams& params) {
    const ReferenceImage &normal = input.before.at("surface_normal"), &color = input.before.at("surface_color"),
                         &material = input.before.at("surface_material");
    const LitVolumes volumes = lit_volumes(input.frame, params);
    const glm::dmat3 to_world = glm::transpose(input.frame.view.to_view);
    ReferenceImage indirect(normal.width, normal.height, normal.layers);
    tbb::parallel_for(0u, normal.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < normal.width; ++x)
            for (std::uint32_t sample = 0; sample < normal.layers; ++sample) {
                if (normal.at(x, y, sample).w <= 0) continue;
                const SurfacePoint p = decoded_surface(
                    input.frame, {normal.at(x, y, sample), color.at(x, y, sample), material.at(x, y, sample)}, x, y);
                const Receiver at{input.frame.view.origin + to_world * p.position, to_world * facing_normal(p)};
                indirect.at(x, y, sample) = glm::dvec4(blended_irradiance(volumes.grids, at) / std::numbers::pi, 1);
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
