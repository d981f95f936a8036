// Sorted lights, bins and tile masks on the device, and the same in C++ for tests.
#pragma once

#include <span>
#include <vector>

#include "passes/graph/step.h"
#include "passes/lighting/z_binned/z_binned.shared.h"
#include "passes/lighting/z_binned/z_binned_params.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::lighting {

/// What the passes leave to shading.
struct ZBins {
    ZBinsPush push{};
    Buffer sorted = {}, header = {}, bins = {}, masks = {};
};

/// Declares the steps up to the masks. Needs a G-buffer.
ZBins z_bins(Graph&, const FrameImages&, const ZBinnedParams&);

/// The first and the last light of every bin: one light per element, sorted by its nearest depth. A bin without lights has its
/// first beyond its last.
struct BinRange {
    std::uint32_t low = 0xffff, high = 0;
    friend bool operator==(const BinRange&, const BinRange&) = default;
};
struct DepthReach {
    float nearest = 0, farthest = 0;
};
std::vector<BinRange> mirror_bins(std::span<const DepthReach> sorted, const ZHeader&, const ZBinsPush&);

}  // namespace strata::lighting
