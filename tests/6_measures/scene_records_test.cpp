// The records a scene becomes on the device are relative to the eye: where in the world a frame was recorded does not matter.
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/particles.h"
#include "captures/scenarios.h"
#include "passes/scene/scene_facts.h"
#include "replay/scene/scene_records.h"

namespace strata {
namespace {

/// The same sight from elsewhere in the world.
Frame moved_by(Frame frame, const glm::dvec3& by) {
    frame.view.origin += by;
    for (Draw& draw : frame.draws) {
        draw.to_world[3] += glm::dvec4(by, 0);
        draw.previous_to_world[3] += glm::dvec4(by, 0);
    }
    for (Emitter& emitter : frame.emitters)
        for (Particle& particle : emitter.particles) particle.center += by;
    for (Light& light : frame.lights) light.position += by;
    for (Blocker& blocker : frame.blockers) blocker.center += by;
    return frame;
}

double apart(const glm::vec3& a, const glm::vec3& b) { return double(glm::length(a - b)); }

// 10 000 km away a float is good to half a meter, a double to 2 nm.
constexpr double no_farther_apart = 1e-5;

TEST(SceneRecords, AreTheSameTenThousandKilometersFromTheOrigin) {
    for (const std::string_view scenario : {"glass_and_smoke", "light_types", "blocker_rooms"}) {
        const Frame frame = (*find_scenario(scenario))->build(0, {.width = 32, .height = 18});
        const Frame moved = moved_by(frame, {7.1e6, -3.3e5, 7.0e6});
        const SceneRecords here = scene_records(SceneFacts(frame)), there = scene_records(SceneFacts(moved));
        ASSERT_EQ(here.draws.size(), there.draws.size());
        for (std::size_t i = 0; i < here.draws.size(); ++i) {
            for (int column = 0; column < 4; ++column)
                EXPECT_LT(apart(here.draws[i].to_view[column], there.draws[i].to_view[column]), no_farther_apart) << scenario;
            EXPECT_LT(apart(here.draws[i].bound_center, there.draws[i].bound_center), no_farther_apart) << scenario;
        }
        for (std::size_t i = 0; i < here.particle_tops.size(); ++i)
            EXPECT_LT(apart({glm::vec2(here.particle_tops[i]), here.particle_depths[i]},
                            {glm::vec2(there.particle_tops[i]), there.particle_depths[i]}),
                      no_farther_apart)
                << scenario;
        for (std::size_t i = 0; i < here.lights.size(); ++i) {
            if (here.lights[i].type == static_cast<uint>(LightType::directional)) continue;  // it is nowhere
            EXPECT_LT(apart(here.lights[i].position, there.lights[i].position), no_farther_apart) << scenario;
        }
        for (std::size_t i = 0; i < here.blockers.size(); ++i)
            EXPECT_LT(apart(here.blockers[i].center, there.blockers[i].center), no_farther_apart) << scenario;
    }
}

}  // namespace
}  // namespace strata
