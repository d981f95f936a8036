// What must hold of the flagship scenario whatever technique draws it.
#include <algorithm>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/no_index.h"
#include "captures/scenarios.h"
#include "passes/reference/blockers.h"
#include "passes/reference/fragments.h"
#include "passes/reference/shade.h"

namespace strata {
namespace {

TEST(AgentsHeadquarters, WithoutItsWindowsLetsNoDaylightIn) {
    const auto scenario = std::ranges::find(scenarios(), "agents_hq", &Scenario::name);
    Frame frame = scenario->build(0, {.width = 640, .height = 360});
    Light& daylight = *std::ranges::find(frame.lights, "daylight", &Light::name);
    daylight.portals.clear();
    const LightBlockers blockers = light_blockers(frame, daylight);
    const glm::dvec4 light = light_point(frame, daylight);
    const VisiblePoints seen = visible_points(frame, opaque_draws(frame));
    std::size_t indoors = 0, lit = 0;
    for (const RasterPoint& point : seen.points) {
        if (point.draw == no_index) continue;
        const SurfacePoint surface = surface_at(frame, point);
        if (glm::dot(surface.normal, glm::dvec3(light)) <= 0) continue;
        ++indoors;
        lit += lets_through(blockers, light, off_surface(surface.position, surface.normal)) ? 1 : 0;
    }
    EXPECT_GT(indoors, 50'000u);
    EXPECT_EQ(lit, 0u) << "a wall or the ceiling leaks";
}

}  // namespace
}  // namespace strata
