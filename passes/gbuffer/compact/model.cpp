// Layout F of docs/algorithms/deferred.md 2.1 in double: attributes stored and read back, depth at the sample.
#include "passes/gbuffer/compact/model.h"

#include <algorithm>
#include <cmath>

#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/compact/compact.shared.h"
#include "passes/gbuffer/layout_model.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {

glm::dvec3 compact_normal(const glm::dvec3& n) { return octahedral_rounded(n, compact_normal_steps); }

SurfacePoint compact_material(SurfacePoint p) {
    p.metallic = p.metallic >= 0.5 ? 1 : 0;
    p.occlusion = std::floor(std::clamp(p.occlusion, 0.0, 1.0) * compact_occlusion_steps + 0.5) / compact_occlusion_steps;
    if (p.model != LightingModel::unlit && p.model != LightingModel::hair) p.model = LightingModel::ggx;
    return p;
}

ImageSet compact_model(const StageInput& input, const Settings& settings) {
    return stored_images(input, settings, [](NearestSurface& s, const SampleAt& at) {
        s.point = stored_color(compact_material(s.point));
        s.point.normal = compact_normal(s.point.normal);
        rebuild_from_depth(s, at);
    });
}

}  // namespace strata::gbuffer
