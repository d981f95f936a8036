// Filtered shadow maps in double, by brute force over the maps as they were drawn: bounds answer sooner and nothing else. Only
// with form=plane the receiver follows the plane of the block under it.
#include <cmath>

#include "passes/settings.h"
#include "passes/shadows/bounds/bounds_model.h"
#include "passes/shadows/lookup.h"
#include "passes/shadows/min_max/min_max.h"
#include "passes/stage_input.h"

namespace strata::shadows {

namespace {

// The share of a plane's distance, and of a texel, by which float may be on the other side of a threshold or of a block's edge.
constexpr double float_share = 0.02, float_texels = 2e-3;

bool is_near_an_edge(const glm::dvec2& u, double block) {
    const glm::dvec2 within = u - block * glm::floor(u / block);
    const glm::dvec2 distance = glm::min(within, block - within);
    return std::min(distance.x, distance.y) < float_texels;
}

Filtered plane_lookup(const LookupScene& scene, const ShadowView& view, const Receiver& receiver,
                      const BoundsSettings& settings) {
    auto at = fixed_place(scene, view, receiver);
    if (!at) return {};
    if (at->size < settings.block) return filter_map(scene.maps, *at, scene.taps());
    const FittedSlab fitted = slab_of(scene.maps, *at, settings);
    at->gradient = fitted.kept.slope;
    if (fitted.kept.is_tilted()) at->rise = glm::dvec2(0);
    Filtered found = filter_map(scene.maps, *at, scene.taps());
    const bool is_close_call = std::abs(fitted.width / double(plane_tolerance) - 1) < float_share;
    if (is_close_call || is_near_an_edge(at->u, settings.block)) found.undecided = true;
    return found;
}

}  // namespace

ImageSet min_max_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<MinMaxParams>();
    if (params.form != form_plane) return visibility_model(input, params.filter, fixed_lookup);
    return visibility_model(input, params.filter,
                            [&](const LookupScene& scene, const ShadowView& view, const Receiver& receiver) {
                                return plane_lookup(scene, view, receiver, params.bounds());
                            });
}

}  // namespace strata::shadows
