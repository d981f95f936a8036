// Where transparent fragments are in the order of blending: at their depth, or before all of the world with an interface layer.
#pragma once

#include <cstdint>
#include <vector>

#include "passes/depth_range.h"

namespace strata {

struct Emitter;  // capture_format/frame/particles.h
struct Frame;    // capture_format/frame.h

/// Of a draw, or of emitter draw - draws.size(); 0 is the world.
std::uint32_t layer_of(const Frame&, std::uint32_t draw);
/// Of everything transparent; 0 where there is no interface.
std::uint32_t highest_layer(const Frame&);

/// In meters, of a fragment of a layer at view depth z, depth offset applied. Of a frame with interface layers: nothing of the
/// world is nearer than the near plane there, whatever its depth offset, so that all layers are in front of it.
double ordering_depth(const Frame&, std::uint32_t layer, double z);

/// View depths of the vertices and particles that are transparent, none nearer than the near plane but for depth offsets; with
/// all interface layers, or of the world alone. Of a frame without any: the near plane and twice that.
DepthRange transparent_depth_range(const Frame&);
DepthRange world_depth_range(const Frame&);

/// The order in which a painter that sorts objects draws what is transparent, as indices like those of transparent_draws(): lower
/// layers first, then lower sort_priority, then, in the world, farther middles of boxes, then earlier submission. Emitters
/// without particles are left out.
std::vector<std::uint32_t> painters_order(const Frame&);
/// The same of an emitter's particles: farther ones first, depth offsets applied.
std::vector<std::uint32_t> painters_order(const Frame&, const Emitter&);

}  // namespace strata
