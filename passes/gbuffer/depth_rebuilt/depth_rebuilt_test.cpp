// Facts of the layout with rebuilt depth: the errors of normals of docs/algorithms/deferred.md 2.5, and depth at the sample.
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/gbuffer/depth_rebuilt/model.h"
#include "passes/gbuffer/layout_model.h"
#include "tests/support/normal_errors.h"

namespace strata::gbuffer {
namespace {

TEST(DepthRebuiltGBuffer, AMillionNormalsAreOffAsTheTableSays) {
    const NormalErrors errors = errors_of_a_million_normals(depth_rebuilt_normal);
    EXPECT_NEAR(errors.worst, .0037, .05 * .0037);
    EXPECT_NEAR(errors.mean, .0013, .05 * .0013);
}

/// Reversed depth is near / z in a float: a step is 2^-24 to 2^-23 of it at every distance.
TEST(DepthRebuiltGBuffer, DepthIsExactToHalfAStepOfAFloatAndLiesAtTheSample) {
    Frame frame;
    frame.view.near = .1f;
    for (double z = .2; z < 5000; z *= 1.7) {
        NearestSurface s;
        s.depth = double(frame.view.near) / z;
        rebuild_from_depth(s, {frame, {.5, .5}, {.125, .375}});
        EXPECT_NEAR(s.point.position.z / z, 1, 0x1p-24);
        EXPECT_EQ(s.offset, glm::dvec2(.125, .375));
    }
}

}  // namespace
}  // namespace strata::gbuffer
