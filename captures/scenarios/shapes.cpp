#include "captures/scenarios/shapes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"

namespace strata::scenario {
namespace {

/// Adds a rectangle with normal cross(right, up); right and up are half edges.
void add_face(Mesh& mesh, glm::vec3 center, glm::vec3 right, glm::vec3 up) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(right, up));
    constexpr std::array<glm::vec2, 4> corners = {glm::vec2(-1, 1), glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1)};
    for (const glm::vec2& corner : corners) {
        mesh.positions.push_back(center + right * corner.x + up * corner.y);
        mesh.normals.push_back(normal);
        mesh.tangents.emplace_back(glm::normalize(right), 1.0f);
        mesh.uv0.emplace_back(0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y);
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
}

/// A point of the outline that is turned around the y axis: distance from the axis, height, and the outward normal.
struct Outline {
    glm::vec2 point, normal;
};

/// Around u = angle / 2 pi; the angle grows to the right seen from outside.
Mesh revolved(std::span<const Outline> outline, std::uint32_t segments) {
    Mesh mesh;
    const auto rows = static_cast<std::uint32_t>(outline.size());
    for (std::uint32_t j = 0; j < rows; ++j) {
        for (std::uint32_t i = 0; i <= segments; ++i) {
            const float u = static_cast<float>(i) / static_cast<float>(segments);
            const float angle = 2 * std::numbers::pi_v<float> * u;
            const glm::vec2 around(std::cos(angle), -std::sin(angle));
            const Outline& at = outline[j];
            mesh.positions.emplace_back(at.point.x * around.x, at.point.y, at.point.x * around.y);
            mesh.normals.push_back(glm::normalize(glm::vec3(at.normal.x * around.x, at.normal.y, at.normal.x * around.y)));
            mesh.tangents.emplace_back(around.y, 0.0f, -around.x, 1.0f);
            mesh.uv0.emplace_back(u, static_cast<float>(j) / static_cast<float>(rows - 1));
        }
    }
    for (std::uint32_t j = 0; j + 1 < rows; ++j) {
        for (std::uint32_t i = 0; i < segments; ++i) {
            const std::uint32_t a = j * (segments + 1) + i, b = a + 1, c = a + segments + 1, d = c + 1;
            if (j + 2 < rows) mesh.indices.insert(mesh.indices.end(), {a, c, d});  // at the lower pole c == d
            if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, d, b});         // at the upper pole a == b
        }
    }
    return mesh;
}

/// A quarter circle of normals from `from` to `to`, angles from +y.
void add_arc(std::vector<Outline>& outline, glm::vec2 center, float radius, glm::vec2 from_to, std::uint32_t steps) {
    for (std::uint32_t i = 0; i <= steps; ++i) {
        const float angle = glm::mix(from_to.x, from_to.y, static_cast<float>(i) / static_cast<float>(steps));
        const glm::vec2 normal(std::sin(angle), std::cos(angle));
        outline.push_back({center + radius * normal, normal});
    }
}

}  // namespace

Mesh quad(glm::vec2 half) {
    Mesh mesh;
    mesh.name = "quad";
    add_face(mesh, glm::vec3(0), {half.x, 0, 0}, {0, half.y, 0});
    return mesh;
}

Mesh box(glm::vec3 half) {
    Mesh mesh;
    mesh.name = "box";
    const glm::vec3 x(half.x, 0, 0), y(0, half.y, 0), z(0, 0, half.z);
    add_face(mesh, z, x, y);
    add_face(mesh, -z, -x, y);
    add_face(mesh, x, -z, y);
    add_face(mesh, -x, z, y);
    add_face(mesh, y, x, -z);
    add_face(mesh, -y, x, z);
    return mesh;
}

Mesh sphere(float radius, std::uint32_t segments) {
    std::vector<Outline> outline;
    add_arc(outline, glm::vec2(0), radius, {0, std::numbers::pi_v<float>}, segments / 2);
    Mesh mesh = revolved(outline, segments);
    mesh.name = "sphere";
    return mesh;
}

Mesh capsule(float radius, float half_length, std::uint32_t segments) {
    constexpr float quarter = std::numbers::pi_v<float> / 2;
    std::vector<Outline> outline;
    add_arc(outline, {0, half_length}, radius, {0, quarter}, segments / 4);
    add_arc(outline, {0, -half_length}, radius, {quarter, 2 * quarter}, segments / 4);
    Mesh mesh = revolved(outline, segments);
    mesh.name = "capsule";
    return mesh;
}

}  // namespace strata::scenario
