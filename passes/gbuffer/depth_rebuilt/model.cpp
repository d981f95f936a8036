// Layout E of docs/algorithms/deferred.md 2.1 in double: attributes stored and read back, depth at the sample.
#include "passes/gbuffer/depth_rebuilt/model.h"

#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/depth_rebuilt/depth_rebuilt.shared.h"
#include "passes/gbuffer/layout_model.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {

glm::dvec3 depth_rebuilt_normal(const glm::dvec3& n) { return octahedral_rounded(n, depth_rebuilt_steps); }

ImageSet depth_rebuilt_model(const StageInput& input, const Settings& settings) {
    return stored_images(input, settings, [](NearestSurface& s, const SampleAt& at) {
        s.point = stored_material(s.point);
        s.point.normal = depth_rebuilt_normal(s.point.normal);
        rebuild_from_depth(s, at);
    });
}

}  // namespace strata::gbuffer
