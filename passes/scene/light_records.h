// The lights of a frame as records of passes/shaders/scene.shared.h: what the device is given and what culling on the CPU reads.
#pragma once

#include <span>
#include <vector>

#include "passes/shaders/scene/lights.shared.h"

namespace strata {

struct Frame;  // capture_format/frame.h
struct Light;  // capture_format/frame/light.h

/// Lights in the order of light_list(), without shadow maps: shadow and visibility_layer are no_index, shadow_slots 0. Their
/// blockers, portals and clip planes lie one light's after the other's.
struct LightRecords {
    std::vector<LightRecord> lights;
    std::vector<BlockerRecord> blockers;       ///< as Frame::blockers
    std::vector<BlockerPortalRecord> portals;  ///< as Frame::portals
    std::vector<LightBlockerRecord> light_blockers;
    std::vector<BlockerPortalRecord> blocker_portals;
    std::vector<ClipPlaneRecord> clip_planes;
};

/// Of light_list().
LightRecords light_records(const Frame&, std::span<const Light>);

}  // namespace strata
