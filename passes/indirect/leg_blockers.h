// Whether a frame's blockers cut the way between two points of its surfaces (docs/algorithms/lighting.md 5.8), in double. They
// are asked whichever light they belong to, and without the thresholds that lights' blockers have: a way from one side of a
// blocker to its other side is cut however near the ends are.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "passes/reference/blockers.h"

namespace strata::indirect {

class LegBlockers {
public:
    explicit LegBlockers(const Frame&);
    /// Light goes from `from` to `to`, view space. A one-sided blocker stops only light from its normal's side.
    bool let_through(const glm::dvec3& from, const glm::dvec3& to) const;

private:
    struct BlockerWithPortals {
        PlacedBlocker shape;
        std::vector<PlacedPortal> portals;
    };
    static bool stops(const BlockerWithPortals&, const glm::dvec3& from, const glm::dvec3& to);

    std::vector<BlockerWithPortals> blockers_;
};

}  // namespace strata::indirect
