#include "captures/scenarios/modeling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"

namespace strata::scenario::part {
namespace {

constexpr float full_turn = 2 * std::numbers::pi_v<float>;

/// Half edges of a box, a right-handed frame.
struct Axes {
    glm::vec3 x, y, z;
};

void add_face(Mesh& mesh, glm::vec3 center, glm::vec3 right, glm::vec3 up) {
    quad(mesh, {center - right - up, center + right - up, center + right + up, center - right + up});
}

void add_turned_box(Mesh& mesh, glm::vec3 center, const Axes& half) {
    add_face(mesh, center + half.z, half.x, half.y);
    add_face(mesh, center - half.z, -half.x, half.y);
    add_face(mesh, center + half.x, -half.z, half.y);
    add_face(mesh, center - half.x, half.z, half.y);
    add_face(mesh, center + half.y, half.x, -half.z);
    add_face(mesh, center - half.y, half.x, half.z);
}

glm::vec3 perpendicular(glm::vec3 direction) {
    return glm::normalize(glm::cross(std::abs(direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), direction));
}

/// Two rings of `segments` + 1 vertices, counted from `lower` and `upper`; turning to the right seen from outside with `upper`
/// up.
void join_rings(Mesh& mesh, glm::uvec2 lower_upper, std::uint32_t segments) {
    const auto add_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::vec3 at = mesh.positions[a], area = glm::cross(mesh.positions[b] - at, mesh.positions[c] - at);
        if (glm::dot(area, area) > 1e-16f) mesh.indices.insert(mesh.indices.end(), {a, b, c});
    };
    for (std::uint32_t i = 0; i < segments; ++i) {
        const std::uint32_t a = lower_upper.x + i, d = lower_upper.y + i;
        add_triangle(a, a + 1, d + 1);
        add_triangle(a, d + 1, d);
    }
}

/// A ring of a turned profile.
struct Ring {
    glm::vec2 point, normal;
    float length = 0;  ///< along the profile
};

std::uint32_t add_ring(Mesh& mesh, const Ring& ring, glm::vec3 foot, std::uint32_t segments) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const float angle = full_turn * float(i) / float(segments), c = std::cos(angle), s = std::sin(angle);
        mesh.positions.push_back(foot + glm::vec3(ring.point.x * c, ring.point.y, -ring.point.x * s));
        mesh.normals.emplace_back(ring.normal.x * c, ring.normal.y, -ring.normal.x * s);
        mesh.tangents.emplace_back(-s, 0.0f, -c, 1.0f);
        mesh.uv0.emplace_back(angle * ring.point.x, ring.length);
    }
    return first;
}

}  // namespace

void quad(Mesh& mesh, const Corners& corners) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec3 right = glm::normalize(corners[1] - corners[0]),
                    normal = glm::normalize(glm::cross(right, corners[3] - corners[0]));
    const glm::vec3 up = glm::cross(normal, right);
    for (const glm::vec3& corner : corners) {
        mesh.positions.push_back(corner);
        mesh.normals.push_back(normal);
        mesh.tangents.emplace_back(right, 1.0f);
        mesh.uv0.emplace_back(glm::dot(corner, right), -glm::dot(corner, up));
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
}

void box(Mesh& mesh, glm::vec3 low, glm::vec3 high) {
    const glm::vec3 half = 0.5f * (high - low);
    add_turned_box(mesh, 0.5f * (low + high), {{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}});
}

void beam(Mesh& mesh, glm::vec3 from, glm::vec3 to, glm::vec2 half) {
    const glm::vec3 along = glm::normalize(to - from), side = perpendicular(along);
    add_turned_box(mesh, 0.5f * (from + to), {0.5f * (to - from), half.x * side, half.y * glm::cross(along, side)});
}

void pipe(Mesh& mesh, std::span<const glm::vec3> line, float radius, std::uint32_t sides) {
    glm::vec3 side = perpendicular(glm::normalize(line[1] - line[0]));
    float length = 0;
    std::vector<std::uint32_t> rings;
    for (std::size_t k = 0; k < line.size(); ++k) {
        const glm::vec3 before = line[k > 0 ? k - 1 : 0], after = line[std::min(k + 1, line.size() - 1)];
        const glm::vec3 way = glm::normalize(after - before);
        side = glm::normalize(side - way * glm::dot(side, way));
        const glm::vec3 other = glm::cross(way, side);
        length += glm::distance(line[k], before);
        rings.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        for (std::uint32_t i = 0; i <= sides; ++i) {
            const float angle = full_turn * float(i) / float(sides), c = std::cos(angle), s = std::sin(angle);
            const glm::vec3 normal = c * side + s * other;
            mesh.positions.push_back(line[k] + radius * normal);
            mesh.normals.push_back(normal);
            mesh.tangents.emplace_back(c * other - s * side, 1.0f);
            mesh.uv0.emplace_back(angle * radius, -length);
        }
        if (k > 0) join_rings(mesh, {rings[k - 1], rings[k]}, sides);
    }
}

void turned(Mesh& mesh, std::span<const glm::vec2> profile, glm::vec3 foot, std::uint32_t segments) {
    constexpr float smooth = 0.64f;  // cosine of 50 degrees
    std::vector<glm::vec2> out;
    for (std::size_t j = 0; j + 1 < profile.size(); ++j) {
        const glm::vec2 way = glm::normalize(profile[j + 1] - profile[j]);
        out.emplace_back(-way.y, way.x);
    }
    const auto shared = [&](std::size_t j, std::size_t neighbor) {
        const bool bends_little = neighbor < out.size() && glm::dot(out[j], out[neighbor]) > smooth;
        return bends_little ? glm::normalize(out[j] + out[neighbor]) : out[j];
    };
    float length = 0;
    for (std::size_t j = 0; j < out.size(); ++j) {
        const float next = length + glm::distance(profile[j], profile[j + 1]);
        const std::uint32_t upper = add_ring(mesh, {profile[j], shared(j, j - 1), length}, foot, segments);
        const std::uint32_t lower = add_ring(mesh, {profile[j + 1], shared(j, j + 1), next}, foot, segments);
        join_rings(mesh, {lower, upper}, segments);
        length = next;
    }
}

void ball(Mesh& mesh, glm::vec3 center, glm::vec2 radii, std::uint32_t segments) {
    std::vector<std::uint32_t> rings;
    const std::uint32_t rows = segments / 2;
    for (std::uint32_t j = 0; j <= rows; ++j) {
        const float angle = 0.5f * full_turn * float(j) / float(rows);
        const glm::vec2 round(std::sin(angle), std::cos(angle));
        rings.push_back(add_ring(mesh, {radii * round, glm::normalize(round / radii), angle * radii.y}, center, segments));
        if (j > 0) join_rings(mesh, {rings[j], rings[j - 1]}, segments);
    }
}

}  // namespace strata::scenario::part
