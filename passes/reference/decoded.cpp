#include "passes/reference/decoded.h"

#include "passes/reference/place_code.h"

namespace strata {

SurfacePoint decoded_surface(const Frame& frame, const DecodedTexels& texels, std::uint32_t x, std::uint32_t y) {
    SurfacePoint p;
    const glm::dvec2 place = glm::dvec2(x, y) + 0.5 + offset_of_place_code(texels.material.w);
    p.position = pixel_ray(frame, place.x, place.y) * texels.normal.w;
    p.normal = glm::dvec3(texels.normal);
    p.base_color = glm::dvec3(texels.color);
    p.roughness = texels.color.w;
    p.model = static_cast<LightingModel>(static_cast<std::uint32_t>(texels.material.x));
    p.metallic = texels.material.y;
    p.occlusion = texels.material.z;
    return p;
}

}  // namespace strata
