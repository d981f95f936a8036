// Triangles that can be told apart by the vertex they begin with, though they share the others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace strata {

/// Appends places in `indices` for the triangles of a range of it, which begins at `first`: the vertices are those of the range,
/// each triangle begins with its own place, and a vertex has as few places beside those as can be. Where vertices are shaded once
/// per place, a closed mesh costs about one per triangle.
void add_places(std::span<const std::uint32_t> indices, std::uint32_t first, std::uint32_t count,
                std::vector<std::uint32_t>& places);

}  // namespace strata
