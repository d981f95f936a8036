// Which draws stand in the scene's draw lists, and in which order: command i of a list draws the i-th of these.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace strata {

struct Frame;  // capture_format/frame.h

/// Indices into Frame::draws in submission order; emitter k has the index draws.size() + k.
struct DrawLists {
    std::vector<std::uint32_t> opaque;       ///< opaque and masked draws
    std::vector<std::uint32_t> casters;      ///< those of `opaque` that cast shadows
    std::vector<std::uint32_t> transparent;  ///< transparent draws, then every emitter
};
DrawLists draw_lists(const Frame&);

/// Interface layer of a draw or an emitter; 0 is the world.
std::uint32_t interface_layer(const Frame&, std::uint32_t index);
/// Of everything transparent; 0 where no draw or emitter is in an interface layer.
std::uint32_t highest_interface_layer(const Frame&, const DrawLists&);

/// Whether these are draws of meshes whose backs do not show. False where an emitter is among them.
bool shows_no_backs(const Frame&, std::span<const std::uint32_t> indices);

/// Triangles of a draw, or two per particle of an emitter.
std::uint32_t triangles_drawn(const Frame&, std::uint32_t index);

}  // namespace strata
