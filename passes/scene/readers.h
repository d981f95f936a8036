// Readers of what stages make for places of the world: surfaces and transparent fragments that the view may show. A stage says
// where each of its products is read; used_products() leaves out the others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/scene/draw_bounds.h"
#include "passes/scene/draw_lists.h"
#include "passes/scene/frustum.h"

namespace strata {

/// Bounds of a draw in view space, from which what it shows may lie off by stored_depth_error.
struct SurfaceBounds {
    BoundingSphere sphere;
    std::array<glm::dvec3, 8> corners;  ///< of its box
};
/// Depth in a G-buffer is a half float in some layouts, wrong by 2.4e-4 of itself: lit places lie that far from their draw.
inline constexpr double stored_depth_error = 1e-3;

/// Answers from bounds alone: never false where a sample of the picture reads, often true where none does, as behind a wall.
class Readers {
public:
    Readers(const Frame&, const DrawLists&, const DrawBounds&);

    /// Opaque and masked draws.
    bool has_surfaces() const { return !surfaces_.empty(); }
    /// Those in view.
    std::span<const SurfaceBounds> surfaces() const { return surfaces_; }
    /// Whether surfaces lie where their bounds say. At several samples a pixel's attributes are those of its center, which may
    /// lie outside of the triangle and, of one seen from the side, anywhere along the ray.
    bool has_exact_places() const;
    /// Of the view itself.
    const Frustum& frustum() const { return frustum_; }
    /// Surfaces whose view depth may lie in the range.
    bool has_surfaces_between(double nearest, double farthest) const;
    /// Surfaces within the sphere, which is in view space.
    bool has_surfaces_in(const BoundingSphere&) const;
    /// Surfaces, transparent draws or particles within the box, which is in the world and along its axes.
    bool has_any_in(const BoundingBox& world) const;

private:
    const Frame* frame_;
    Frustum frustum_;
    // Of draws and emitters that the view may show.
    std::vector<SurfaceBounds> surfaces_;
    std::vector<BoundingSphere> fragments_;
};

/// A part of what a stage makes: a map, a grid.
struct Product {
    std::string name;  ///< "light grid 0"
    bool is_used = true;
    std::string unused_because;  ///< "no surface is in view"
};

/// Numbers of the products that are used, below `count`; the graph lists the others as left out. All of them where
/// FrameImages::makes_unused.
template <typename ProductOf>
std::vector<std::uint32_t> used_products(Graph& graph, const FrameImages& frame, std::size_t count, const ProductOf& product_of) {
    std::vector<std::uint32_t> used;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Product product = frame.makes_unused ? Product() : product_of(i);
        if (product.is_used) used.push_back(i);
        else graph.leave_out(product.name, product.unused_because);
    }
    return used;
}

}  // namespace strata
