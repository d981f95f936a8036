#include "capture_format/import/gltf_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <fmt/core.h>

#include "capture_format/frame/material.h"

namespace strata::gltf {
namespace {

glm::vec3 unit_or(glm::vec3 vector, glm::vec3 fallback) {
    const glm::dvec3 wide(vector);  // squares of small coordinates leave the range of float
    const double length = std::sqrt(glm::dot(wide, wide));
    return length > 0 && std::isfinite(length) ? glm::vec3(wide / length) : fallback;
}

glm::vec3 face_normal(const Mesh& mesh, std::size_t first) {
    const glm::dvec3 a(mesh.positions[mesh.indices[first]]), b(mesh.positions[mesh.indices[first + 1]]),
        c(mesh.positions[mesh.indices[first + 2]]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = std::sqrt(glm::dot(normal, normal));
    return length > 0 ? glm::vec3(normal / length) : glm::vec3(0, 1, 0);
}

/// Any unit vector perpendicular to a unit normal.
glm::vec3 perpendicular(glm::vec3 normal) {
    const glm::vec3 axis = std::abs(normal.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return unit_or(glm::cross(axis, normal), axis);
}

/// Every stream keeps only what the indices use, in their order.
template <typename T>
std::vector<T> gathered(const std::vector<T>& stream, std::span<const std::uint32_t> indices) {
    std::vector<T> result;
    if (stream.empty()) return result;
    result.reserve(indices.size());
    for (const std::uint32_t index : indices) result.push_back(stream[index]);
    return result;
}

/// Makes what a mesh lacks for its material.
class Finisher {
public:
    explicit Finisher(Mesh mesh) : mesh_(std::move(mesh)) {}

    FinishedMesh run(const Material& material) {
        // vertex alpha is coverage only where the material blends or masks
        const bool covers = material.alpha_mode != AlphaMode::opaque;
        for (glm::vec4& color : mesh_.colors) color.w = covers ? std::clamp(color.w, 0.0f, 1.0f) : 1.0f;
        check_normals();
        if (mesh_.normals.empty()) make_flat_normals(mesh_);
        supply_uvs(material);
        finish_tangents(material);
        return {std::move(mesh_), std::move(warnings_)};
    }

private:
    /// Normals become unit. One without a direction takes its triangle's.
    void check_normals() {
        std::vector<bool> broken(mesh_.normals.size());
        for (std::size_t i = 0; i < mesh_.normals.size(); ++i) {
            mesh_.normals[i] = unit_or(mesh_.normals[i], glm::vec3(0));
            broken[i] = mesh_.normals[i] == glm::vec3(0);
        }
        const auto count = std::count(broken.begin(), broken.end(), true);
        if (count == 0) return;
        warnings_.push_back(fmt::format("{} normals have no direction; they take that of a triangle", count));
        for (std::size_t i = 0; i < mesh_.indices.size(); ++i) {
            if (broken[mesh_.indices[i]]) mesh_.normals[mesh_.indices[i]] = face_normal(mesh_, i / 3 * 3);
        }
        for (glm::vec3& normal : mesh_.normals) normal = unit_or(normal, {0, 1, 0});
    }

    /// A textured material on a mesh without that uv set: glTF leaves it open, we read the texture at uv (0, 0).
    void supply_uvs(const Material& material) {
        for (const TextureUse* use : {&material.base_color_texture, &material.metallic_roughness_texture,
                                      &material.normal_texture, &material.emissive_texture, &material.occlusion_texture}) {
            std::vector<glm::vec2>& uvs = use->uv_set == 1 ? mesh_.uv1 : mesh_.uv0;
            if (use->texture == no_index || !uvs.empty()) continue;
            uvs.resize(mesh_.positions.size(), glm::vec2(0));
            warnings_.push_back(fmt::format("it has no uv set {}, which its material uses; all uvs are 0", use->uv_set));
        }
    }

    void finish_tangents(const Material& material) {
        if (mesh_.tangents.size() != mesh_.positions.size()) mesh_.tangents.clear();  // flat normals made new vertices
        for (std::size_t i = 0; i < mesh_.tangents.size(); ++i) {
            const glm::vec3 unit = unit_or(glm::vec3(mesh_.tangents[i]), perpendicular(mesh_.normals[i]));
            mesh_.tangents[i] = glm::vec4(unit, mesh_.tangents[i].w < 0 ? -1.0f : 1.0f);
        }
        if (mesh_.tangents.empty() && material.normal_texture.texture != no_index) make_tangents(mesh_, material.normal_texture);
    }

    Mesh mesh_;
    std::vector<std::string> warnings_;
};

}  // namespace

void make_flat_normals(Mesh& mesh) {
    mesh.positions = gathered(mesh.positions, mesh.indices);
    mesh.uv0 = gathered(mesh.uv0, mesh.indices);
    mesh.uv1 = gathered(mesh.uv1, mesh.indices);
    mesh.colors = gathered(mesh.colors, mesh.indices);
    mesh.tangents.clear();
    mesh.normals.clear();
    for (std::uint32_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = i;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) mesh.normals.insert(mesh.normals.end(), 3, face_normal(mesh, i));
}

void make_tangents(Mesh& mesh, const TextureUse& use) {
    const std::vector<glm::vec2>& uvs = use.uv_set == 1 ? mesh.uv1 : mesh.uv0;
    std::vector<glm::dvec3> along_u(mesh.positions.size(), glm::dvec3(0)), along_v = along_u;
    const auto uv = [&](std::uint32_t vertex) {
        const glm::dvec2 p = uvs.empty() ? glm::vec2(0) : uvs[vertex];
        const std::array<float, 6>& m = use.transform;
        return glm::dvec2(m[0] * p.x + m[1] * p.y + m[2], m[3] * p.x + m[4] * p.y + m[5]);
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const glm::dvec3 e1 = glm::dvec3(mesh.positions[b]) - glm::dvec3(mesh.positions[a]);
        const glm::dvec3 e2 = glm::dvec3(mesh.positions[c]) - glm::dvec3(mesh.positions[a]);
        const glm::dvec2 d1 = uv(b) - uv(a), d2 = uv(c) - uv(a);
        const double area = d1.x * d2.y - d2.x * d1.y;
        if (area == 0) continue;
        const double sign = area < 0 ? -1 : 1;  // not divided by area: larger triangles in space count more
        const glm::dvec3 u = (e1 * d2.y - e2 * d1.y) * sign, v = (e2 * d1.x - e1 * d2.x) * sign;
        for (const std::uint32_t vertex : {a, b, c}) {
            along_u[vertex] += u;
            along_v[vertex] += v;
        }
    }
    mesh.tangents.clear();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 n(mesh.normals[i]);
        const glm::vec3 tangent = unit_or(glm::vec3(along_u[i] - n * glm::dot(n, along_u[i])), perpendicular(mesh.normals[i]));
        const bool mirrored = glm::dot(glm::cross(n, glm::dvec3(tangent)), along_v[i]) > 0;
        mesh.tangents.emplace_back(tangent, mirrored ? -1.0f : 1.0f);
    }
}

FinishedMesh finish_mesh(Mesh mesh, const Material& material) { return Finisher(std::move(mesh)).run(material); }

}  // namespace strata::gltf
