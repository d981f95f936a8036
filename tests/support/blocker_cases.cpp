#include "tests/support/blocker_cases.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <random>

#include "capture_format/frame/light.h"
#include "passes/shaders/blockers.shared.h"

namespace strata {
namespace {

using lighting::Cell;
using lighting::Reach;

class Dice {
public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}
    double between(double low, double high) { return low + (high - low) * double(engine_()) * 0x1p-32; }
    /// Every factor is as likely.
    double scaled(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
    bool chance(double share) { return between(0, 1) < share; }
    std::uint32_t up_to(std::uint32_t most) { return static_cast<std::uint32_t>(engine_() % (most + 1)); }
    glm::dvec3 direction() {
        const double z = between(-1, 1), turn = between(0, 6.283185307179586), r = std::sqrt(1 - z * z);
        return {r * std::cos(turn), r * std::sin(turn), z};
    }

private:
    std::mt19937 engine_;
};

/// A tile of 16 pixels of 1280 x 720 at 90 degrees of height, flat or as deep again as it is far.
Cell<float> random_cell(Dice& dice, lighting::TileRays<float>& rays) {
    const double left = dice.between(-1.7, 1.7), bottom = dice.between(-1, 0.95);
    rays = {float(left), float(left + 16. / 360), float(bottom), float(bottom + 16. / 360)};
    const double near = dice.scaled(0.3, 40);
    return lighting::cell_between(rays, float(near), float(near * (dice.chance(.2) ? 1 : dice.between(1, 2))));
}

glm::vec3 point_of(Dice& dice, const Cell<float>& cell, const lighting::TileRays<float>& rays) {
    const double z = dice.between(double(cell.z_near), double(cell.z_far));
    const glm::vec3 p(z * glm::dvec3(dice.between(double(rays.left), double(rays.right)),
                                     dice.between(double(rays.bottom), double(rays.top)), 1));
    return p + glm::vec3(dice.direction()) * std::max(least_surface_offset, surface_offset_per_meter * p.z);
}

/// Mostly around the way from the light to the cell; some of them edge-on, some without area.
BlockerRecord random_blocker(Dice& dice, const glm::dvec3& cell, const glm::dvec4& light) {
    const glm::dvec3 way = light.w > 0 ? glm::dvec3(light) - cell : glm::dvec3(light) * dice.scaled(0.1, 30);
    const double size = dice.scaled(0.02, 8);
    glm::dvec3 normal = dice.direction();
    if (dice.chance(.15)) normal = glm::normalize(glm::cross(normal, way) + way * dice.between(-.01, .01));
    const glm::dvec3 u = glm::normalize(glm::cross(normal, dice.direction()));
    return {.normal = glm::vec3(normal),
            .half_u = float(dice.chance(.03) ? 0 : size),
            .center = glm::vec3(cell + way * dice.between(-.2, 1.1) + dice.direction() * size * dice.between(0, 1.5)),
            .half_v = float(size * dice.scaled(0.2, 5)),
            .u = glm::vec3(u),
            .one_sided = dice.chance(.1) ? 1u : 0u};
}

BlockerPortalRecord random_portal(Dice& dice, const BlockerRecord& blocker, std::uint32_t index) {
    const double turn = dice.chance(.5) ? 0 : dice.between(-3, 3);
    return {.center = {blocker.half_u * float(dice.between(-1, 1)), blocker.half_v * float(dice.between(-1, 1))},
            .half_extent = {blocker.half_u * float(dice.chance(.1) ? 0 : dice.between(0, 1.5)),
                            blocker.half_v * float(dice.between(0, 1.5))},
            .turn = {float(std::cos(turn)), float(std::sin(turn))},
            .blocker = index};
}

LightRecord random_light(Dice& dice, const glm::dvec3& cell) {
    LightRecord light{};
    const bool directional = dice.chance(.2);
    light.type = static_cast<std::uint32_t>(directional ? LightType::directional : LightType::omni);
    light.direction = glm::vec3(dice.direction());
    light.position = glm::vec3(cell + dice.direction() * dice.scaled(0.05, 40));
    return light;
}

float dot(const glm::vec3& a, const glm::vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

glm::vec3 plane_crossing(const BlockerRecord& blocker, const glm::vec4& light, const glm::vec3& position) {
    const glm::vec3 l = glm::vec3(light) - blocker.center * light.w, p = position - blocker.center;
    const float height = dot(blocker.normal, l), before = std::abs(height);
    const float at = height < 0 ? -dot(blocker.normal, p) : dot(blocker.normal, p);
    const bool stops =
        before > (light.w > 0 ? light_before_blocker : direction_before_blocker) && (blocker.one_sided == 0 || height > 0);
    if (!stops || at >= -point_behind_blocker) return glm::vec3(0);
    const glm::vec3 v = glm::cross(blocker.normal, blocker.u);
    return {before * dot(blocker.u, p) - at * dot(blocker.u, l), before * dot(v, p) - at * dot(v, l), before - at * light.w};
}

bool inside(const BlockerPortalRecord& portal, const glm::vec3& at) {
    const glm::vec2 d = glm::vec2(at) - portal.center * at.z;
    const glm::vec2 turned(portal.turn.x * d.x + portal.turn.y * d.y, portal.turn.x * d.y - portal.turn.y * d.x);
    return std::abs(turned.x) < portal.half_extent.x * at.z && std::abs(turned.y) < portal.half_extent.y * at.z;
}

bool any_open(const BlockerCases& cases, const LightRecord& light, const glm::vec3& at, std::uint32_t mask) {
    for (; mask != 0; mask &= mask - 1)
        if (inside(cases.portals[light.first_portal + static_cast<std::uint32_t>(std::countr_zero(mask))], at)) return true;
    return false;
}

}  // namespace

BlockerCases blocker_cases(std::size_t count, std::uint32_t seed) {
    Dice dice(seed);
    BlockerCases cases;
    for (std::size_t i = 0; i < count; ++i) {
        lighting::TileRays<float> rays;
        const Cell<float> cell = random_cell(dice, rays);
        const glm::dvec3 middle = .5 * glm::dvec3(cell.corners[0] + cell.corners[7]);
        LightRecord light = random_light(dice, middle);
        light.first_blocker = static_cast<std::uint32_t>(cases.light_blockers.size());
        light.first_portal = static_cast<std::uint32_t>(cases.portals.size());
        light.blockers = 1 + dice.up_to(4);
        for (std::uint32_t b = 0; b < light.blockers; ++b) {
            const auto index = static_cast<std::uint32_t>(cases.blockers.size());
            const BlockerRecord& blocker =
                cases.blockers.emplace_back(random_blocker(dice, middle, glm::dvec4(light_point(light))));
            LightBlockerRecord use{.blocker = index, .portals = 0};
            for (std::uint32_t k = dice.up_to(2); k > 0; --k) {
                use.portals |= 1u << light.portals++;
                cases.portals.push_back(random_portal(dice, blocker, index));
            }
            cases.light_blockers.push_back(use);
        }
        cases.lights.push_back(light);
        cases.cells.push_back(cell);
        for (std::size_t k = 0; k < points_per_case; ++k) cases.points.push_back(point_of(dice, cell, rays));
    }
    return cases;
}

glm::vec4 light_point(const LightRecord& light) {
    const bool directional = light.type == static_cast<std::uint32_t>(LightType::directional);
    return directional ? glm::vec4(-light.direction, 0) : glm::vec4(light.position, 1);
}

std::uint32_t low_bits(std::uint32_t count) { return count >= 32 ? ~0u : (1u << count) - 1; }

bool blockers_pass(const BlockerCases& cases, const LightRecord& light, const glm::vec3& position, glm::uvec2 masks) {
    for (std::uint32_t mask = masks.x; mask != 0; mask &= mask - 1) {
        const LightBlockerRecord& use =
            cases.light_blockers[light.first_blocker + static_cast<std::uint32_t>(std::countr_zero(mask))];
        const BlockerRecord& blocker = cases.blockers[use.blocker];
        const glm::vec3 at = plane_crossing(blocker, light_point(light), position);
        const bool stopped = at.z > 0 && std::abs(at.x) <= blocker.half_u * at.z && std::abs(at.y) <= blocker.half_v * at.z;
        if (stopped && !any_open(cases, light, at, use.portals & masks.y)) return false;
    }
    return true;
}

CaseClasses classes(const BlockerCases& cases, std::size_t index) {
    const LightRecord& light = cases.lights[index];
    CaseClasses result;
    const auto add = [&](std::vector<Reach>& to, const BlockerRecord& rectangle) {
        to.push_back(lighting::classify(rectangle, light_point(light), cases.cells[index]));
    };
    for (std::uint32_t b = 0; b < light.blockers; ++b)
        add(result.blockers, cases.blockers[cases.light_blockers[light.first_blocker + b].blocker]);
    for (std::uint32_t k = 0; k < light.portals; ++k) {
        const BlockerPortalRecord& portal = cases.portals[light.first_portal + k];
        add(result.portals, lighting::portal_rectangle(cases.blockers[portal.blocker], portal));
    }
    return result;
}

CaseMasks masks(const BlockerCases& cases, std::size_t index, const CaseClasses& classes) {
    const LightRecord& light = cases.lights[index];
    CaseMasks result;
    std::uint32_t open = 0;
    for (std::uint32_t k = 0; k < light.portals; ++k) {
        if (classes.portals[k] == Reach::full) open |= 1u << k;
        if (classes.portals[k] == Reach::partial) result.portals |= 1u << k;
    }
    for (std::uint32_t b = 0; b < light.blockers; ++b) {
        const std::uint32_t holes = cases.light_blockers[light.first_blocker + b].portals;
        if ((holes & open) != 0 || classes.blockers[b] == Reach::none) continue;
        if (classes.blockers[b] == Reach::full && (holes & result.portals) == 0) result.killed = true;
        result.blockers |= 1u << b;
    }
    return result;
}

}  // namespace strata
