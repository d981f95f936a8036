// Readers of what stages make for places of the world: surfaces and transparent fragments that the view may show. A stage says
// where each of its products is read; used_products() leaves out the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/scene/draw_bounds.h"
#include "passes/scene/draw_lists.h"
#include "passes/scene/frustum.h"

namespace strata {

/// Answers from bounds alone: never false where a sample of the picture reads, often true where none does, as behind a wall.
class Readers {
public:
    Readers(const Frame&, const DrawLists&, const DrawBounds&);

    /// Opaque and masked draws.
    bool has_surfaces() const { return !surfaces_.empty(); }
    /// Surfaces whose view depth may lie in the range.
    bool has_surfaces_between(double nearest, double farthest) const;
    /// Surfaces within the sphere, which is in view space.
    bool has_surfaces_in(const BoundingSphere&) const;
    /// Surfaces, transparent draws or particles within the box, which is in the world and along its axes.
    bool has_any_in(const BoundingBox& world) const;

private:
    const Frame* frame_;
    Frustum frustum_;
    std::vector<BoundingSphere> surfaces_, fragments_;  ///< of draws and emitters that the view may show, in view space
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
