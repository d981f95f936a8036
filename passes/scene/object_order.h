// The order of object-sorted transparency: the world before interface layers, then sort_priority, then the view depth of the
// object's bounding sphere's center, far to near. The scene's index buffers have it; models have passes/reference/ordering.h.
#pragma once

#include <cstdint>
#include <vector>

namespace strata {

struct Emitter;  // capture_format/frame/particles.h
struct Frame;    // capture_format/frame.h

/// Draws with a transparent material and emitters with particles (as draws.size() + emitter): lower layers first, then lower
/// sort_priority, then, in the world, farther centers, then earlier submission. The center is that of the mesh's box,
/// transformed; an emitter's is that of the box of its particles' centers.
std::vector<std::uint32_t> back_to_front_draws(const Frame&);

/// Indices into Emitter::particles, in the world by descending view z of center minus depth_offset (which counts as 0 where it is
/// not finite: such a particle does not show), then ascending index.
std::vector<std::uint32_t> back_to_front_particles(const Frame&, const Emitter&);

}  // namespace strata
