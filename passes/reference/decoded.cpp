#include "passes/reference/decoded.h"

namespace strata {

SurfacePoint decoded_surface(const Frame& frame, const DecodedTexels& texels, std::uint32_t x, std::uint32_t y) {
    SurfacePoint p;
    p.position = pixel_ray(frame, x + 0.5, y + 0.5) * texels.normal.w;
    p.normal = glm::dvec3(texels.normal);
    p.base_color = glm::dvec3(texels.color);
    p.roughness = texels.color.w;
    p.model = static_cast<LightingModel>(static_cast<std::uint32_t>(texels.material.x));
    p.metallic = texels.material.y;
    p.occlusion = texels.material.z;
    return p;
}

}  // namespace strata
