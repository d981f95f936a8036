#include "tests/4_references/random_blockers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace strata::tiny {
namespace {

constexpr int blockers = 48;

glm::dvec3 direction(Random& random) {
    for (;;)
        if (const glm::dvec3 d = random.inside(-1, 1); glm::length(d) > .1 && glm::length(d) < 1) return glm::normalize(d);
}

glm::dvec3 across(Random& random, const glm::dvec3& axis) { return glm::normalize(glm::cross(axis, direction(random))); }

float half_extent(Random& random, double most) { return random() < .04 ? 0 : float(random.between(.05, most)); }

/// A fifth has axes that are almost as far from unit and perpendicular as the capture format allows.
Blocker blocker(Random& random, const glm::dvec3& eye) {
    const glm::dvec3 u = random() < .3 ? glm::dvec3(1, 0, 0) : direction(random), v = across(random, u);
    const double error = random() < .2 ? 1e-3 : 0;
    return {.center = eye + random.inside(-8, 8),
            .u = glm::vec3(u * (1 + error)),
            .v = glm::vec3(v + u * error),
            .half_u = half_extent(random, 5),
            .half_v = half_extent(random, 5),
            .one_sided = random() < .3};
}

/// On the blocker and turned, off its plane and leaning, or beside it.
Portal portal(Random& random, const Blocker& in, std::uint32_t index) {
    const glm::dvec3 u(in.u), v(in.v), normal = glm::cross(u, v);
    const double turn = random() < .5 ? 0 : random.between(-3, 3), lean = random() < .7 ? 0 : random.between(-1, 1);
    const glm::dvec3 along = std::cos(turn) * u + std::sin(turn) * v, aside = glm::cross(glm::normalize(normal), along);
    const double reach = random() < .8 ? 1 : 2;
    return {.center = in.center + random.between(-reach, reach) * double(in.half_u) * u +
                      random.between(-reach, reach) * double(in.half_v) * v + random.between(-.2, .2) * normal,
            .u = glm::vec3(glm::normalize(along + lean * normal)),
            .v = glm::vec3(random() < .5 ? aside : glm::normalize(glm::cross(normal, along + lean * normal))),
            .half_u = half_extent(random, 1),
            .half_v = half_extent(random, 1),
            .blocker = index};
}

/// The same portal again, edge to edge and a little higher, or 2 mm too far away for that.
Portal next_to(Random& random, const Portal& first) {
    Portal second = first;
    second.half_u = half_extent(random, 1);
    const double apart = double(first.half_u) + double(second.half_u) + (random() < .7 ? 0 : .002);
    second.center += apart * glm::dvec3(first.u) + .3 * double(first.half_v) * glm::dvec3(first.v);
    return second;
}

void list_blockers(Random& random, const Frame& frame, Light& light) {
    const auto pick = [&](std::size_t count, double share) {
        std::vector<std::uint32_t> list;
        for (std::uint32_t i = 0; i < count; ++i)
            for (int times = random() < .02 ? 2 : 1; times > 0; --times)
                if (random() < share) list.insert(list.begin() + std::ptrdiff_t(random() * double(list.size() + 1)), i);
        return list;
    };
    const double share = random() < .5 ? 1 : random();
    light.blockers = pick(frame.blockers.size(), share);
    light.portals = pick(frame.portals.size(), random());
}

}  // namespace

Frame blockers_at_random(Random& random) {
    Frame frame;
    const glm::dvec3 x = direction(random), y = across(random, x);
    frame.view.to_view = glm::dmat3(x, y, glm::cross(x, y) * (random() < .5 ? -1. : 1.));
    frame.view.origin = random.inside(-1e4, 1e4);
    const glm::dvec3 eye = frame.view.origin;
    for (std::uint32_t i = 0; i < blockers; ++i) {
        const Blocker& in = frame.blockers.emplace_back(blocker(random, eye));
        if (random() < .3) continue;
        const Portal first = portal(random, in, i);
        frame.portals.push_back(first);
        if (random() < .4) frame.portals.push_back(next_to(random, first));
    }
    for (const LightType type : {LightType::omni, LightType::sphere, LightType::directional}) {
        Light light{.type = type, .position = eye + random.inside(-8, 8), .direction = glm::vec3(direction(random))};
        const Blocker& near = frame.blockers[std::size_t(random() * blockers)];
        if (random() < .3) light.position = near.center + glm::dvec3(near.u) * random.between(-9, 9);  // in its plane
        light.intensity = {1, 1, 1};
        light.range = float(random() < .5 ? 100 : random.between(.5, 12));
        light.source_radius = type == LightType::sphere ? .3f : 0;
        list_blockers(random, frame, light);
        frame.lights.push_back(light);
    }
    return frame;
}

}  // namespace strata::tiny
