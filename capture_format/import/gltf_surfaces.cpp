#include "capture_format/import/gltf_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "capture_format/frame/texture.h"
#include "capture_format/import/gltf_streams.h"
#include "capture_format/srgb.h"

namespace strata::gltf {
namespace {

constexpr double points_wanted = 65536;
constexpr int most_points_per_edge = 256;

struct Triangle {
    std::array<glm::dvec2, 3> uv0{}, uv1{};
    double area = 0;
};

void add_triangles(std::vector<Triangle>& triangles, const Mesh& mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        Triangle triangle;
        std::array<glm::dvec3, 3> p;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t vertex = mesh.indices[i + c];
            p[c] = glm::dvec3(mesh.positions[vertex]);
            if (!mesh.uv0.empty()) triangle.uv0[c] = glm::dvec2(mesh.uv0[vertex]);
            if (!mesh.uv1.empty()) triangle.uv1[c] = glm::dvec2(mesh.uv1[vertex]);
        }
        triangle.area = glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / 2;
        if (triangle.area > 0) triangles.push_back(triangle);
    }
}

/// Two halves of the unit square.
std::vector<Triangle> whole_square() {
    const glm::dvec2 a(0, 0), b(1, 0), c(0, 1), d(1, 1);
    return {{{a, b, c}, {a, b, c}, 1}, {{b, d, c}, {b, d, c}, 1}};
}

/// The centers of edge * edge equal parts.
void visit_parts(const Triangle& triangle, int edge, const std::function<void(const SurfacePoint&)>& visit) {
    const auto at = [](const std::array<glm::dvec2, 3>& uv, double s, double t) {
        return uv[0] + (uv[1] - uv[0]) * s + (uv[2] - uv[0]) * t;
    };
    const double area = triangle.area / edge / edge;
    for (int row = 0; row < edge; ++row)
        for (int part = 0; part < 2 * (edge - row) - 1; ++part) {  // every second one stands on its tip
            const double third = part % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
            const double s = (part / 2 + third) / edge, t = (row + third) / edge;
            visit({at(triangle.uv0, s, t), at(triangle.uv1, s, t), area});
        }
}

/// A coordinate in texels of so many.
std::size_t wrapped(double coordinate, std::uint32_t texels, AddressMode mode) {
    double within = coordinate - std::floor(coordinate);
    if (mode == AddressMode::clamp) within = std::clamp(coordinate, 0.0, 1.0);
    if (mode == AddressMode::mirror) within = 1 - std::abs(coordinate - 2 * std::floor(coordinate / 2) - 1);
    return std::min(static_cast<std::size_t>(within * texels), std::size_t{texels} - 1);
}

}  // namespace

void for_surface_points(const Document& document, int material, MemoryBudget budget,
                        const std::function<void(const SurfacePoint&)>& visit) {
    std::vector<Triangle> triangles;
    for (const MeshSource& mesh : document.meshes)
        for (const Primitive& primitive : mesh.primitives) {
            if (primitive.material != material) continue;
            const auto streams = read_streams(document, primitive, budget);  // what is wrong with it is said where it is shown
            if (streams) add_triangles(triangles, streams->mesh);
        }
    if (triangles.empty()) triangles = whole_square();
    double area = 0;
    for (const Triangle& triangle : triangles) area += triangle.area;
    for (const Triangle& triangle : triangles) {
        const double edge = std::ceil(std::sqrt(points_wanted * triangle.area / area));
        visit_parts(triangle, static_cast<int>(std::clamp<double>(edge, 1, most_points_per_edge)), visit);
    }
}

glm::dvec4 TexelLookup::at(const SurfacePoint& point) const {
    if (texture == nullptr) return glm::dvec4(1);
    const glm::dvec2& uv = uv_set == 1 ? point.uv1 : point.uv0;
    const glm::dmat3x2 m(transform[0], transform[3], transform[1], transform[4], transform[2], transform[5]);
    const glm::dvec2 moved = m * glm::dvec3(uv, 1);
    const std::size_t x = wrapped(moved.x, texture->width, address_u(texture->address)),
                      y = wrapped(moved.y, texture->height, address_v(texture->address));
    const std::byte* texel = &texture->texels[(y * texture->width + x) * 4];
    glm::dvec4 value;
    for (int c = 0; c < 4; ++c) {
        const float channel = static_cast<float>(static_cast<unsigned>(texel[c])) / 255;
        const bool is_srgb = texture->format == TextureFormat::rgba8_srgb && c < 3;
        value[c] = static_cast<double>(is_srgb ? decode_srgb(channel) : channel);
    }
    return value;
}

}  // namespace strata::gltf
