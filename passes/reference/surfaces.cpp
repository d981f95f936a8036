// surface_at: attributes, textures and the normal map of a point.
#include "passes/reference/surfaces.h"

#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"
#include "passes/reference/textures.h"

namespace strata {
namespace {

// Shorter than this a tangent has no direction (glTF demands unit tangents; absent ones are zero).
constexpr double shortest_tangent = 1e-10;

// What textures need to know of a point: its attributes, and those one pixel on in its 2x2 quad, as dFdxFine and dFdyFine see.
struct Footprint {
    Attributes here, along_x, along_y;
    double sign_x = 1, sign_y = 1;  ///< the neighbor is left or above: -1
};

glm::dvec4 texture_at(const Frame& frame, const TextureUse& use, const Footprint& footprint) {
    if (use.texture == no_index) return glm::dvec4(1);
    const Texture& texture = frame.textures[use.texture];
    const std::size_t set = use.uv_set == 0 ? 0 : 1;
    const glm::dvec2 uv = transformed(use, footprint.here.uv[set]);
    const glm::dvec2 per_x = footprint.sign_x * (transformed(use, footprint.along_x.uv[set]) - uv);
    const glm::dvec2 per_y = footprint.sign_y * (transformed(use, footprint.along_y.uv[set]) - uv);
    return filtered(texture, uv, level_of_detail(texture, per_x, per_y));
}

/// Of mip 0: what rays see, having no pixel to filter over.
glm::dvec4 finest_texel(const Frame& frame, const TextureUse& use, const Attributes& at) {
    if (use.texture == no_index) return glm::dvec4(1);
    return filtered(frame.textures[use.texture], transformed(use, at.uv[use.uv_set == 0 ? 0 : 1]), 0);
}

Footprint footprint_at(const Frame& frame, const RasterPoint& point, const Corners& corners, const glm::dvec3& position) {
    const View& view = frame.view;
    const TriangleRays rays(corners);
    Footprint footprint;
    footprint.sign_x = point.x % 2 == 0 ? 1 : -1;
    footprint.sign_y = point.y % 2 == 0 ? 1 : -1;
    const glm::dvec3 ray = position / position.z;
    const double right = footprint.sign_x * 2 / (double(view.width) * double(view.projection[0][0]));
    const double down = footprint.sign_y * 2 / (double(view.height) * double(view.projection[1][1]));
    footprint.here = attributes_at(frame, point.draw, point.triangle, point.barycentric);
    footprint.along_x = attributes_at(frame, point.draw, point.triangle, rays.barycentric(ray + glm::dvec3(right, 0, 0)));
    footprint.along_y = attributes_at(frame, point.draw, point.triangle, rays.barycentric(ray + glm::dvec3(0, down, 0)));
    return footprint;
}

// The outward normal of the triangle itself, for meshes without normals.
glm::dvec3 face_normal(const Corners& corners, double handedness) {
    return glm::normalize(handedness * glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

// Normal map in the frame (tangent, bitangent, normal); the bitangent is cross(normal, tangent) w in object space, so a
// mirrored transform turns the cross product of view space around.
glm::dvec3 mapped(const DrawSpace& space, const glm::dvec3& normal, const glm::dvec4& tangent, const glm::dvec3& local) {
    const glm::dvec3 carried = space.linear * glm::dvec3(tangent);
    const glm::dvec3 across = carried - normal * glm::dot(normal, carried);
    if (glm::length(across) < shortest_tangent) return normal;
    const glm::dvec3 t = glm::normalize(across);
    const glm::dvec3 b = glm::cross(normal, t) * (tangent.w * space.handedness);
    return glm::normalize(t * local.x + b * local.y + normal * local.z);
}

glm::dvec3 shading_normal(const Frame& frame, const RasterPoint& point, const Corners& corners, const Footprint& footprint) {
    const Material& material = *material_of(frame, point.draw);
    const DrawSpace space = draw_space(frame, point.draw);
    const glm::dvec3 vertex_normal = space.normals * footprint.here.normal;
    const bool flat = glm::dot(vertex_normal, vertex_normal) == 0;
    glm::dvec3 normal = flat ? face_normal(corners, space.handedness) : glm::normalize(vertex_normal);
    if (material.normal_texture.texture != no_index) {
        glm::dvec3 local = glm::dvec3(texture_at(frame, material.normal_texture, footprint)) * 2.0 - 1.0;
        local.x *= double(material.normal_scale);
        local.y *= double(material.normal_scale);
        normal = mapped(space, normal, footprint.here.tangent, local);
    }
    return point.front_facing ? normal : -normal;
}

// Where hair's fiber points: along the tangent, or out of the surface where there is none.
glm::dvec3 fiber(const Frame& frame, const RasterPoint& point, const Footprint& footprint, const glm::dvec3& normal) {
    const glm::dvec3 along = draw_space(frame, point.draw).linear * glm::dvec3(footprint.here.tangent);
    return glm::length(along) < shortest_tangent ? normal : glm::normalize(along);
}

SurfacePoint particle_surface(const Frame& frame, const RasterPoint& point, const Footprint& footprint, SurfacePoint surface) {
    TextureUse use;
    use.texture = frame.emitters[point.draw - frame.draws.size()].texture;
    const glm::dvec4 texel = texture_at(frame, use, footprint);
    surface.base_color = glm::dvec3(footprint.here.color) * glm::dvec3(texel);
    surface.alpha = footprint.here.color.w * texel.w;
    surface.emissive = footprint.here.emissive * glm::dvec3(texel) * texel.w;
    surface.model = LightingModel::unlit;
    return surface;
}

}  // namespace

SurfacePoint surface_at(const Frame& frame, const RasterPoint& point) {
    return surface_at(frame, point, view_corners(frame, draw_space(frame, point.draw), point.draw, point.triangle));
}

SurfacePoint surface_at(const Frame& frame, const RasterPoint& point, const Corners& corners) {
    SurfacePoint surface;
    const glm::dvec3& b = point.barycentric;
    surface.position = b.x * corners[0] + b.y * corners[1] + b.z * corners[2];
    const Footprint footprint = footprint_at(frame, point, corners, surface.position);
    const Material* material = material_of(frame, point.draw);
    if (material == nullptr) return particle_surface(frame, point, footprint, surface);

    const glm::dvec4 base =
        glm::dvec4(material->base_color) * footprint.here.color * texture_at(frame, material->base_color_texture, footprint);
    const glm::dvec4 rough_metal = texture_at(frame, material->metallic_roughness_texture, footprint);
    const double occlusion = texture_at(frame, material->occlusion_texture, footprint).x;
    surface.normal = shading_normal(frame, point, corners, footprint);
    if (material->lighting_model == LightingModel::hair) surface.normal = fiber(frame, point, footprint, surface.normal);
    surface.base_color = glm::dvec3(base);
    surface.alpha = base.w;
    if (has_metals(material->lighting_model)) surface.metallic = double(material->metallic) * rough_metal.z;
    surface.roughness = double(material->roughness) * rough_metal.y;
    surface.occlusion = 1 + double(material->occlusion_strength) * (occlusion - 1);
    surface.emissive = glm::dvec3(material->emissive) * glm::dvec3(texture_at(frame, material->emissive_texture, footprint));
    surface.transmission = material->transmission;
    surface.model = material->lighting_model;
    return surface;
}

double alpha_at(const Frame& frame, std::uint32_t draw, std::uint32_t triangle, const glm::dvec3& barycentric) {
    const Attributes attributes = attributes_at(frame, draw, triangle, barycentric);
    const Material* material = material_of(frame, draw);
    TextureUse use;
    if (material != nullptr) {
        use = material->base_color_texture;
    } else {
        use.texture = frame.emitters[draw - frame.draws.size()].texture;
    }
    const double own = material != nullptr ? double(material->base_color.w) : 1;
    return own * attributes.color.w * finest_texel(frame, use, attributes).w;
}

glm::dvec3 diffuse_albedo(const Frame& frame, std::uint32_t draw, const Attributes& at) {
    const Material& material = *material_of(frame, draw);
    if (material.lighting_model == LightingModel::unlit) return glm::dvec3(0);
    const glm::dvec4 base = glm::dvec4(material.base_color) * at.color * finest_texel(frame, material.base_color_texture, at);
    if (!has_metals(material.lighting_model)) return glm::dvec3(base);
    return glm::dvec3(base) * (1 - double(material.metallic) * finest_texel(frame, material.metallic_roughness_texture, at).z);
}

}  // namespace strata
