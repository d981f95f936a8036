#include "capture_format/import/gltf_pose.h"

#include <algorithm>
#include <cassert>

namespace strata::gltf {
namespace {

/// base + sum of weight * displacement over the targets that have one.
template <typename Displacements>
glm::dvec3 morphed(glm::vec3 base, std::size_t vertex, const Streams& streams, const Displacements& displacements,
                   std::span<const double> weights) {
    glm::dvec3 sum(base);
    for (std::size_t target = 0; target < std::min(streams.targets.size(), weights.size()); ++target) {
        const std::vector<glm::vec3>& moves = streams.targets[target].*displacements;
        if (weights[target] != 0 && !moves.empty()) sum += weights[target] * glm::dvec3(moves[vertex]);
    }
    return sum;
}

glm::dmat4 blended(const Streams& streams, std::size_t vertex, std::span<const glm::dmat4> joints) {
    glm::dmat4 sum(0);
    double total = 0;
    for (std::size_t i = vertex * streams.influences; i < (vertex + 1) * streams.influences; ++i) {
        const auto weight = static_cast<double>(streams.weights[i]);
        if (weight == 0) continue;
        sum += weight * joints[streams.joints[i]];
        total += weight;
    }
    return total > 0 ? sum / total : glm::dmat4(1);  // the weights are floats: their sum is 1 but for rounding
}

/// The inverse transpose but for its length, which a normal has no use for: the cofactors, with the determinant's sign. It
/// exists for matrices that have no inverse, too.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(m[0], cofactors[0]) < 0 ? cofactors * -1.0 : cofactors;
}

glm::dvec3 unit(const glm::dvec3& vector) {
    const double length = glm::length(vector);
    return length > 0 ? vector / length : vector;
}

}  // namespace

Mesh posed(const Streams& streams, const Pose& pose) {
    assert(pose.joints.empty() || pose.joints.size() >= streams.joint_end);
    Mesh mesh = streams.mesh;
    const bool skinned = !pose.joints.empty() && streams.influences > 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dmat4 matrix = skinned ? blended(streams, i, pose.joints) : glm::dmat4(1);
        const glm::dvec3 p = morphed(mesh.positions[i], i, streams, &MorphTarget::positions, pose.weights);
        mesh.positions[i] = glm::vec3(matrix * glm::dvec4(p, 1));
        if (!mesh.normals.empty()) {
            const glm::dvec3 n = morphed(mesh.normals[i], i, streams, &MorphTarget::normals, pose.weights);
            mesh.normals[i] = glm::vec3(skinned ? unit(normal_matrix(glm::dmat3(matrix)) * n) : n);
        }
        if (!mesh.tangents.empty()) {
            const glm::dvec3 t = morphed(glm::vec3(mesh.tangents[i]), i, streams, &MorphTarget::tangents, pose.weights);
            mesh.tangents[i] = glm::vec4(glm::vec3(skinned ? unit(glm::dmat3(matrix) * t) : t), mesh.tangents[i].w);
        }
    }
    return mesh;
}

}  // namespace strata::gltf
