// Lookups of shadow maps in double: what the models of the stage's techniques go through. The maps are those the device drew.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "passes/image_set.h"
#include "passes/scene/shadow_views.h"
#include "passes/shadow_filter.h"
#include "passes/shadows/kernel.h"
#include "passes/shadows/receivers.h"

namespace strata::shadows {

struct LookupScene {
    const Frame& frame;
    const ReferenceImage& maps;
    std::vector<ShadowView> views;
    std::vector<Light> lights;
    ShadowFilter filter;

    LookupScene(const Frame&, const ReferenceImage& maps, const ShadowFilter&);
    std::int64_t taps() const { return std::int64_t(2) << filter.kernel; }
};

/// Where a receiver that moves towards the light by its bias is looked up in a map. The slope bias is that of a kernel with this
/// radius in texels; `reach` is how many texels outside the map the kernel may still touch it. Nothing where it does not.
struct KernelSize {
    double radius = 0, reach = 0;
};
std::optional<Lookup> biased_lookup(const LookupScene&, const ShadowView&, const Receiver&, KernelSize);

/// What a plane with this normal, through a lookup's place, gains in map depth per texel; zero where it is seen edge on.
glm::dvec2 plane_gradient(const ShadowView&, const Lookup&, const glm::dvec3& normal);

/// Where a fixed kernel is looked up; nothing where it does not touch the map.
std::optional<Lookup> fixed_place(const LookupScene&, const ShadowView&, const Receiver&);
/// The share of one map that it lights.
Filtered fixed_lookup(const LookupScene&, const ShadowView&, const Receiver&);

/// "visibility" by a lookup per map: cascades blend, cubes have faces.
using LookUp = std::function<Filtered(const LookupScene&, const ShadowView&, const Receiver&)>;
ImageSet visibility_model(const StageInput&, const ShadowFilter&, const LookUp&);

}  // namespace strata::shadows
