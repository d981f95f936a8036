// Where triangles are: see the header for the conventions, fragments.h for the corners of particles.
#include "passes/reference/triangles.h"

#include <glm/gtc/matrix_inverse.hpp>

#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "passes/reference/shade.h"

namespace strata {
namespace {

// Corner order and uv of a particle's quad, as fragments.h documents them.
constexpr std::array<glm::dvec2, 4> quad_corners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
constexpr std::array<std::array<std::uint32_t, 3>, 2> quad_halves = {{{0, 1, 2}, {0, 2, 3}}};

const Particle& particle_of(const Frame& frame, std::uint32_t draw, std::uint32_t triangle) {
    return frame.emitters[draw - frame.draws.size()].particles[triangle / 2];
}

Corners particle_corners(const Frame& frame, const Particle& particle, std::uint32_t half) {
    const glm::dvec3 center = to_view(frame, particle.center);
    const double size = particle.size, c = std::cos(double(particle.rotation)), s = std::sin(double(particle.rotation));
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 corner = quad_corners[quad_halves[half][i]];
        corners[i] = center + size * glm::dvec3(corner.x * c - corner.y * s, corner.x * s + corner.y * c, 0);
    }
    return corners;
}

Attributes particle_attributes(const Particle& particle, std::uint32_t half, const glm::dvec3& barycentric) {
    Attributes result;
    glm::dvec2 corner(0);
    for (std::size_t i = 0; i < 3; ++i) corner += barycentric[glm::length_t(i)] * quad_corners[quad_halves[half][i]];
    const glm::dvec4 cell = particle.uv_frame;
    result.uv[0] = glm::dvec2(cell.x + cell.z * (0.5 + 0.5 * corner.x), cell.y + cell.w * (0.5 - 0.5 * corner.y));
    result.uv[1] = result.uv[0];
    result.color = glm::dvec4(particle.color, particle.alpha);
    result.emissive = particle.emissive;
    result.depth_offset = std::isfinite(particle.depth_offset) ? double(particle.depth_offset) : 0;
    return result;
}

// Weighted sum of a stream at three indices; `absent` where the mesh has no such stream.
template <typename Value, typename Element>
Value interpolate(const std::vector<Element>& stream, const std::array<std::uint32_t, 3>& indices, const glm::dvec3& b,
                  Value absent) {
    if (stream.empty()) return absent;
    return b.x * Value(stream[indices[0]]) + b.y * Value(stream[indices[1]]) + b.z * Value(stream[indices[2]]);
}

}  // namespace

DrawSpace draw_space(const Frame& frame, std::uint32_t draw) {
    DrawSpace space;
    if (draw >= frame.draws.size()) return space;
    const glm::dmat4& to_world = frame.draws[draw].to_world;
    space.linear = frame.view.to_view * glm::dmat3(to_world);
    space.offset = to_view(frame, glm::dvec3(to_world[3]));
    space.normals = glm::inverseTranspose(space.linear);
    space.handedness = glm::determinant(space.linear) < 0 ? -1 : 1;
    return space;
}

const Material* material_of(const Frame& frame, std::uint32_t draw) {
    return draw < frame.draws.size() ? &frame.materials[frame.draws[draw].material] : nullptr;
}

std::uint32_t triangle_count(const Frame& frame, std::uint32_t draw) {
    if (draw < frame.draws.size()) return static_cast<std::uint32_t>(frame.meshes[frame.draws[draw].mesh].indices.size() / 3);
    return static_cast<std::uint32_t>(2 * frame.emitters[draw - frame.draws.size()].particles.size());
}

std::array<std::uint32_t, 3> corner_indices(const Frame& frame, std::uint32_t draw, std::uint32_t triangle) {
    const std::vector<std::uint32_t>& indices = frame.meshes[frame.draws[draw].mesh].indices;
    const std::size_t first = std::size_t(triangle) * 3;
    return {indices[first], indices[first + 1], indices[first + 2]};
}

Corners view_corners(const Frame& frame, const DrawSpace& space, std::uint32_t draw, std::uint32_t triangle) {
    if (draw >= frame.draws.size()) return particle_corners(frame, particle_of(frame, draw, triangle), triangle % 2);
    const Mesh& mesh = frame.meshes[frame.draws[draw].mesh];
    const std::array<std::uint32_t, 3> indices = corner_indices(frame, draw, triangle);
    Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = space.linear * glm::dvec3(mesh.positions[indices[i]]) + space.offset;
    return corners;
}

Attributes attributes_at(const Frame& frame, std::uint32_t draw, std::uint32_t triangle, const glm::dvec3& barycentric) {
    if (draw >= frame.draws.size()) return particle_attributes(particle_of(frame, draw, triangle), triangle % 2, barycentric);
    const Mesh& mesh = frame.meshes[frame.draws[draw].mesh];
    const std::array<std::uint32_t, 3> indices = corner_indices(frame, draw, triangle);
    Attributes result;
    result.normal = interpolate(mesh.normals, indices, barycentric, result.normal);
    result.tangent = interpolate(mesh.tangents, indices, barycentric, result.tangent);
    result.uv[0] = interpolate(mesh.uv0, indices, barycentric, result.uv[0]);
    result.uv[1] = interpolate(mesh.uv1, indices, barycentric, result.uv[1]);
    result.color = interpolate(mesh.colors, indices, barycentric, result.color);
    return result;
}

TriangleRays::TriangleRays(const Corners& corners) {
    const glm::dvec3 e1 = corners[1] - corners[0], e2 = corners[2] - corners[0], to_eye = -corners[0];
    area = glm::cross(e2, e1);
    first = glm::cross(e2, to_eye);
    second = glm::cross(to_eye, e1);
    volume = glm::dot(e2, second);
}

glm::dvec3 TriangleRays::barycentric(const glm::dvec3& ray) const {
    const double inverse = 1 / glm::dot(ray, area);
    const double b1 = glm::dot(ray, first) * inverse, b2 = glm::dot(ray, second) * inverse;
    return {1 - b1 - b2, b1, b2};
}

}  // namespace strata
