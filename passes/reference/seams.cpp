// Sides between triangles that are one flat piece, such as the diagonal of a quad: samples on them are not undecided.
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "capture_format/frame/mesh.h"
#include "passes/reference/raster.h"

namespace strata {
namespace {

struct Side {
    std::uint32_t triangle = 0, side = 0, uses = 0;
};

constexpr std::uint64_t directed(std::uint64_t from, std::uint64_t to) { return from << 32 | to; }

// Relative to the values at hand: mesh streams are float.
constexpr double float_noise = 1e-5;

// Whether the stream at `vertex` is what the triangle extrapolates to.
template <typename Element>
bool continues(const std::vector<Element>& stream, const std::uint32_t* triangle, const glm::dvec3& weights,
               std::uint32_t vertex) {
    if (stream.empty()) return true;
    const double reach = std::abs(weights.x) + std::abs(weights.y) + std::abs(weights.z) + 1;
    for (glm::length_t i = 0; i < Element::length(); ++i) {
        const double a = stream[triangle[0]][i], b = stream[triangle[1]][i], c = stream[triangle[2]][i], d = stream[vertex][i];
        const double size = std::max({std::abs(a), std::abs(b), std::abs(c), std::abs(d)});
        if (std::abs(weights.x * a + weights.y * b + weights.z * c - d) > float_noise * reach * size) return false;
    }
    return true;
}

// Barycentrics of a vertex with respect to a triangle, by least squares: `continues` of the positions tells whether it fits.
glm::dvec3 weights_of(const Mesh& mesh, const std::uint32_t* triangle, std::uint32_t vertex) {
    const glm::dvec3 origin = mesh.positions[triangle[0]];
    const glm::dvec3 e1 = glm::dvec3(mesh.positions[triangle[1]]) - origin, e2 = glm::dvec3(mesh.positions[triangle[2]]) - origin;
    const glm::dvec3 normal = glm::cross(e1, e2), to_vertex = glm::dvec3(mesh.positions[vertex]) - origin;
    const double squared = glm::dot(normal, normal);
    const double b1 = glm::dot(glm::cross(to_vertex, e2), normal) / squared;
    const double b2 = glm::dot(glm::cross(e1, to_vertex), normal) / squared;
    return {1 - b1 - b2, b1, b2};
}

bool one_flat_piece(const Mesh& mesh, const std::uint32_t* triangle, std::uint32_t vertex) {
    const glm::dvec3 weights = weights_of(mesh, triangle, vertex);
    if (!std::isfinite(weights.x + weights.y + weights.z)) return false;
    return continues(mesh.positions, triangle, weights, vertex) && continues(mesh.normals, triangle, weights, vertex) &&
           continues(mesh.tangents, triangle, weights, vertex) && continues(mesh.uv0, triangle, weights, vertex) &&
           continues(mesh.uv1, triangle, weights, vertex) && continues(mesh.colors, triangle, weights, vertex);
}

}  // namespace

std::vector<std::uint8_t> seams_of_mesh(const Mesh& mesh) {
    const std::uint32_t count = static_cast<std::uint32_t>(mesh.indices.size() / 3);
    std::unordered_map<std::uint64_t, Side> sides;
    for (std::uint32_t i = 0; i < count * 3; ++i) {
        const std::uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        Side& side = sides[directed(mesh.indices[i], mesh.indices[next])];
        side = {.triangle = i / 3, .side = i % 3, .uses = side.uses + 1};
    }
    std::vector<std::uint8_t> seams(count, 0);
    for (std::uint32_t i = 0; i < count * 3; ++i) {
        const std::uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        const auto there = sides.find(directed(mesh.indices[next], mesh.indices[i]));
        if (there == sides.end() || there->second.uses != 1 || sides[directed(mesh.indices[i], mesh.indices[next])].uses != 1)
            continue;
        const std::uint32_t opposite = mesh.indices[there->second.triangle * 3 + (there->second.side + 2) % 3];
        if (one_flat_piece(mesh, &mesh.indices[std::size_t(i / 3) * 3], opposite)) {
            seams[i / 3] = static_cast<std::uint8_t>(seams[i / 3] | 1u << i % 3);
        }
    }
    return seams;
}

}  // namespace strata
