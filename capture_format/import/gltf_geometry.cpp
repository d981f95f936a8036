#include "capture_format/import/gltf_geometry.h"

#include <algorithm>
#include <cmath>

#include "capture_format/import/gltf_accessors.h"
#include "capture_format/import/gltf_check.h"
#include "capture_format/import/gltf_meshes.h"
#include "capture_format/import/gltf_pose.h"

namespace strata::gltf {

bool Geometry::moves(const Node& node, const Primitive& primitive) {
    return !primitive.targets.empty() || (node.skin >= 0 && primitive.attributes.contains("JOINTS_0"));
}

std::uint32_t Geometry::material_of(const Primitive& primitive) const {
    const std::size_t last = materials_.size() - 1;  // what primitives without a material get
    const auto index = static_cast<std::size_t>(primitive.material);
    return static_cast<std::uint32_t>(primitive.material >= 0 ? std::min(index, last) : last);
}

void Geometry::warn(const MeshSource& source, const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) warnings_.push_back(fmt::format("mesh '{:.60}': {}", source.name, sentence));
}

Result<void> Geometry::read(const Node& node) {
    if (node.mesh < 0) return {};
    if (static_cast<std::size_t>(node.mesh) >= document_.meshes.size()) {
        return within(no_such("mesh", node.mesh, document_.meshes.size()), "node '{node:.60}'", node.name);
    }
    if (node.skin >= 0) {
        if (const auto read = read_skin(node.skin); !read) return read;
    }
    const MeshSource& mesh = document_.meshes[static_cast<std::size_t>(node.mesh)];
    for (const Primitive& primitive : mesh.primitives) {
        const auto read = read_primitive(node, mesh, primitive);
        if (!read) return within(read.error(), "mesh '{mesh:.60}'", mesh.name);
    }
    return {};
}

Result<void> Geometry::read_primitive(const Node& node, const MeshSource& source, const Primitive& primitive) {
    const bool moving = moves(node, primitive);
    if (moving ? !moving_.contains(&primitive) : !fixed_index_.contains(&primitive)) {
        auto streams = read_streams(document_, primitive, budget_);
        if (!streams) return streams.error();
        warn(source, streams->warnings);
        FinishedMesh finished = finish_mesh(streams->mesh, materials_[material_of(primitive)]);
        warn(source, finished.warnings);
        if (moving) moving_.emplace(&primitive, *std::move(streams));
        if (!moving) keep_fixed(source, primitive, std::move(finished.mesh));
    }
    if (!moving || node.skin < 0) return {};
    const std::size_t needed = moving_.at(&primitive).joint_end, joints = bind_.at(node.skin).size();
    if (needed > joints)
        return fail(Fault::bad_input, "import.gltf.joint_range", "a vertex uses joint {joint} of a skin that has {joints}",
                    needed - 1, joints);
    return {};
}

void Geometry::keep_fixed(const MeshSource& source, const Primitive& primitive, Mesh mesh) {
    const bool shows = !mesh.indices.empty();
    fixed_index_[&primitive] = shows ? static_cast<std::uint32_t>(fixed_.size()) : no_index;
    if (!shows) return;
    mesh.name = source.name;
    fixed_.push_back(std::move(mesh));
}

Result<void> Geometry::read_skin(int index) {
    if (bind_.contains(index)) return {};
    if (static_cast<std::size_t>(index) >= document_.skins.size()) {
        return no_such("skin", index, document_.skins.size());
    }
    const Skin& skin = document_.skins[static_cast<std::size_t>(index)];
    for (const int joint : skin.joints) {
        if (joint < 0 || static_cast<std::size_t>(joint) >= document_.nodes.size()) {
            return within(no_such("node", joint, document_.nodes.size()), "skin {skin}, joints", index);
        }
    }
    std::vector<glm::dmat4> matrices(skin.joints.size(), glm::dmat4(1));
    if (skin.inverse_bind_matrices >= 0) {
        const auto values = read_floats(document_, skin.inverse_bind_matrices, 16, budget_);
        if (!values) return within(values.error(), "skin {skin}", index);
        if (values->size() < matrices.size() * 16) {
            return fail(Fault::bad_input, "import.gltf.bind_matrices",
                        "skin {skin} has {joints} joints and {matrices} inverse bind matrices", index, matrices.size(),
                        values->size() / 16);
        }
        for (std::size_t i = 0; i < matrices.size() * 16; ++i) {
            if (!std::isfinite((*values)[i])) return within(not_finite(), "skin {skin}, inverse bind matrices", index);
            matrices[i / 16][static_cast<int>(i % 16 / 4)][static_cast<int>(i % 4)] = static_cast<double>((*values)[i]);
        }
    }
    bind_.emplace(index, std::move(matrices));
    return {};
}

Mesh Geometry::posed_mesh(const MeshSource& source, const Primitive& primitive, std::span<const double> weights,
                          std::span<const glm::dmat4> joints) const {
    Mesh mesh = posed(streams(primitive), {weights, joints});
    mesh = finish_mesh(std::move(mesh), materials_[material_of(primitive)]).mesh;
    mesh.name = source.name;
    return mesh;
}

}  // namespace strata::gltf
