// The stage gbuffer: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/gbuffer/judge.h"
#include "passes/gbuffer/truth.h"
#include "passes/stages.h"

namespace strata::gbuffer {
namespace {

std::optional<std::string> always_wanted(const Features&) { return std::nullopt; }

}  // namespace

StageInfo stage() {
    return {.purpose = "stores the nearest opaque surface of every sample",
            .unwanted = always_wanted,
            .outputs = {"surface_normal", "surface_color", "surface_material", "emission", "depth_layers", "depth", "gbuffer0",
                        "gbuffer1", "gbuffer2"},
            .truth = gbuffer_truth,
            .judge = gbuffer_judge,
            .settle = settle_gbuffer,
            .scenarios = {"one_sphere", "materials", "lighting_models", "opaque_only", "city_of_boxes", "sun_and_boxes",
                          "fence_and_foliage", "sixteen_normals", "far_wall"},
            // Depth is alike in all layouts, and readers of given surfaces do not read the layout.
            .leaves = {"depth", "gbuffer0", "gbuffer1", "gbuffer2"}};
}

}  // namespace strata::gbuffer
