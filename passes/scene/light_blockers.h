// Light blockers and portals as records of passes/shaders/scene.shared.h: rectangles in view space, and for each light the ones
// that can stop it (docs/algorithms/lighting.md 0.2, 2.2 and 2.6). passes/reference/blockers.h derives the same by its own code.
#pragma once

#include <vector>

#include "passes/shaders/scene/lights.shared.h"

namespace strata {

struct Frame;  // capture_format/frame.h
struct Light;  // capture_format/frame/light.h

/// One record per blocker, in the order of Frame::blockers. Half extents are 1e-5 of the greater and 1e-5 m larger than recorded,
/// so that a rounded position between two blockers that share an edge is inside one of them.
std::vector<BlockerRecord> blocker_records(const Frame&);

/// One record per portal, in the order of their blockers, those of one blocker in the order of Frame::portals: what whoever asks
/// about any way between two points reads, while lights have their own lists. Portals of one blocker that share an edge are made
/// 1e-4 m wider, so that no line is left between them.
std::vector<BlockerPortalRecord> portal_records(const Frame&);

/// What can stop one light, in the order in which the light lists it.
struct LightBlockerRecords {
    std::vector<LightBlockerRecord> blockers;  ///< at most 32
    std::vector<BlockerPortalRecord> portals;  ///< at most 32, each a hole in at least one of the blockers
};

/// Blockers within the light's range that face it and whose plane it is not in. Of more than 32 those with the greatest solid
/// angle seen from the light are kept, of equal ones the earlier. Portals without area and portals beside their blocker are left
/// out. Portals of one blocker that share an edge are wider, as those of portal_records().
LightBlockerRecords light_blocker_records(const Frame&, const Light&);

}  // namespace strata
