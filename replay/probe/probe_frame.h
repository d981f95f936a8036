// The frame that makes a technique show its T(z): a row of pixels that all see the same fragments as black cards, and a probe of
// radiance 1 in each, every one at another depth. Of its light T arrives.
#pragma once

#include <span>

#include "passes/reference/fragments.h"

namespace strata {

struct Frame;  // capture_format/frame.h

/// What carries a probe's light.
enum class ProbeKind {
    none,
    additive,    ///< light alone: it hides nothing
    thin_black,  ///< for techniques without additive fragments: a card of thin_probe_alpha without light, and one of radiance 1;
    thin_white,  ///< what is brighter, over the alpha, is what arrives
};
constexpr double thin_probe_alpha = 1. / 256;

struct ProbePoint {
    double depth = 1;        ///< meters, within the range
    std::size_t before = 0;  ///< submitted just before this fragment, or after all
};

struct ProbeScene {
    std::span<const Fragment> fragments;  ///< in submission order
    double nearest = 1, farthest = 2;     ///< meters: the range of depth, pinned by two cards out of sight
    std::span<const ProbePoint> points;   ///< a pixel each
    ProbeKind kind = ProbeKind::additive;
    float background = 0;
    std::uint64_t seed = 0;
};

Frame probe_frame(const ProbeScene&);

}  // namespace strata
