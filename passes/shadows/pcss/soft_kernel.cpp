// The kernel of soft lights in double.
#include "passes/shadows/pcss/soft_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strata::shadows {

namespace {

// Distance from the light in meters, the sun's from wherever depth is 0.
double distance(const SoftLookup& soft, double depth) { return soft.near > 0 ? soft.near / depth : -depth * soft.depth_meters; }

// A texel against the receiver's plane over its center.
struct Compared {
    double map = 0;
    bool is_lit = true, undecided = false;
};

Compared compare(const ReferenceImage& maps, const SoftLookup& soft, glm::ivec2 texel) {
    const glm::ivec2 last(static_cast<int>(soft.at.size) - 1);
    const glm::ivec2 seen = soft.at.is_face ? glm::clamp(texel, glm::ivec2(0), last) : texel;
    const glm::dvec2 away = glm::dvec2(seen) + 0.5 - soft.at.u;
    const double plane = std::max(soft.at.depth + glm::dot(soft.gradient, away), 0.0);
    const double map = map_depth(maps, soft.at, seen);
    // The plane's rise is a difference of products of floats.
    const double doubt = soft.at.doubt + 1e-5 * glm::length(soft.gradient) * glm::length(away);
    return {.map = map, .is_lit = plane >= map, .undecided = map > 0 && std::abs(plane - map) <= doubt};
}

struct Blockers {
    double distances = 0;
    std::int64_t count = 0;
    bool undecided = false;
};

Blockers search(const ReferenceImage& maps, const SoftLookup& soft) {
    const double radius = disc_radius(soft, 1);
    Blockers found;
    for (std::int64_t i = 0; i < soft.search; ++i) {
        const glm::dvec2 tap = soft.at.u + radius * disc_tap(i, soft.search, soft.turn);
        const Compared here = compare(maps, soft, glm::ivec2(glm::floor(tap)));
        found.undecided = found.undecided || here.undecided;
        // A tap on the border of two texels may have been either's.
        for (const glm::dvec2 step : {glm::dvec2(-1, 0), glm::dvec2(1, 0), glm::dvec2(0, -1), glm::dvec2(0, 1)}) {
            const Compared beside = compare(maps, soft, glm::ivec2(glm::floor(tap + soft.texel_doubt * step)));
            const bool same = beside.is_lit == here.is_lit && (here.is_lit || std::abs(beside.map - here.map) < 1e-3 * here.map);
            if (!same) found.undecided = true;
        }
        if (here.is_lit) continue;
        found.distances += distance(soft, here.map);
        ++found.count;
    }
    return found;
}

// The nearest four texels, fractions cut to 1/256.
Filtered bilinear(const ReferenceImage& maps, const SoftLookup& soft, glm::dvec2 u) {
    const glm::dvec2 corner = glm::floor(u - 0.5), fraction = glm::floor((u - 0.5 - corner) * 256.0) / 256.0;
    Filtered result{.lit = 0};
    for (const glm::ivec2 step : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
        const double share = (step.x == 0 ? 1 - fraction.x : fraction.x) * (step.y == 0 ? 1 - fraction.y : fraction.y);
        const Compared texel = compare(maps, soft, glm::ivec2(corner) + step);
        if (texel.is_lit) result.lit += share;
        if (texel.undecided && share > 0) result.undecided = true;
    }
    return result;
}

}  // namespace

double penumbra(double source, double receiver, double blocker) { return source * (receiver - blocker) / blocker; }

double sun_penumbra(double source, double receiver, double blocker) { return source * (receiver - blocker); }

glm::dvec2 disc_tap(std::int64_t i, std::int64_t n, double turn) {
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    const double angle = double(i) * golden_angle + turn;
    return std::sqrt((double(i) + 0.5) / double(n)) * glm::dvec2(std::cos(angle), std::sin(angle));
}

double disc_radius(const SoftLookup& soft, double blocker_depth) {
    const double receiver = distance(soft, soft.at.depth), blocker = distance(soft, blocker_depth);
    const double texels = soft.near > 0 ? penumbra(soft.source, receiver, blocker) / (soft.texel * receiver)
                                        : sun_penumbra(soft.source, receiver, blocker) / soft.texel;
    return 0.5 * std::clamp(texels, 1.0, 64.0);
}

Filtered filter_soft(const ReferenceImage& maps, const SoftLookup& soft) {
    const Blockers found = search(maps, soft);
    if (found.count == 0) return {.lit = 1, .undecided = found.undecided};
    const double mean = found.distances / double(found.count);
    const double radius = disc_radius(soft, soft.near > 0 ? soft.near / mean : -mean / soft.depth_meters);
    Filtered result{.lit = 0, .undecided = found.undecided};
    for (std::int64_t i = 0; i < soft.filter; ++i) {
        const Filtered tap = bilinear(maps, soft, soft.at.u + radius * disc_tap(i, soft.filter, soft.turn));
        result.lit += tap.lit;
        result.undecided = result.undecided || tap.undecided;
    }
    result.lit /= double(soft.filter);
    return result;
}

}  // namespace strata::shadows
