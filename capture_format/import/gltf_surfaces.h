// What of a texture is seen: points on the triangles that show a material. Textures are often atlases of many materials, so a
// mean over the whole of one is a mean over other materials, too.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include <glm/glm.hpp>

#include "capture_format/import/gltf_document.h"
#include "capture_format/memory_budget.h"

namespace strata {

struct Texture;  // capture_format/frame/texture.h

}  // namespace strata

namespace strata::gltf {

struct SurfacePoint {
    glm::dvec2 uv0{0}, uv1{0};
    double area = 1;  ///< of the surface that the point stands for, in the mesh's own space
};

/// Visits about 65,000 points spread evenly over all triangles of the document that show the material, one of each triangle at
/// least. A material that no triangle shows is visited at points of the whole unit square of uvs. The budget is for what is read
/// meanwhile.
void for_surface_points(const Document&, int material, MemoryBudget, const std::function<void(const SurfacePoint&)>& visit);

/// The nearest texel of the finest mip, linear; filtering changes no mean.
struct TexelLookup {
    const Texture* texture = nullptr;  ///< rgba8, or none: white
    std::uint32_t uv_set = 0;
    std::array<float, 6> transform = {1, 0, 0, 0, 1, 0};

    glm::dvec4 at(const SurfacePoint&) const;
};

}  // namespace strata::gltf
