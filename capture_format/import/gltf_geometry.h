// The meshes of a glTF: those that never change are made once, those that a skin or morph targets move are made for every pose.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame/material.h"
#include "capture_format/import/gltf_document.h"
#include "capture_format/import/gltf_streams.h"
#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

class Geometry {
public:
    /// Reads what the shown nodes need. All three outlive the geometry.
    Geometry(const Document& document, std::span<const Material> materials, MemoryBudget& budget)
        : document_(document), materials_(materials), budget_(budget) {}
    Result<void> read(const Node&);

    /// The meshes that never change: the first ones of every frame.
    const std::vector<Mesh>& fixed() const { return fixed_; }
    /// The index of a fixed mesh; no_index when the primitive shows nothing.
    std::uint32_t fixed_mesh(const Primitive& primitive) const { return fixed_index_.at(&primitive); }
    /// The vertices of a primitive that moves; its finished mesh for a pose comes from posed_mesh().
    const Streams& streams(const Primitive& primitive) const { return moving_.at(&primitive); }
    Mesh posed_mesh(const MeshSource&, const Primitive&, std::span<const double> weights,
                    std::span<const glm::dmat4> joints) const;
    /// Bind matrices of a skin, one per joint.
    const std::vector<glm::dmat4>& inverse_bind_matrices(int skin) const { return bind_.at(skin); }

    /// The frame's material of a primitive: materials beyond the list are the last one.
    std::uint32_t material_of(const Primitive&) const;
    const std::vector<std::string>& warnings() const { return warnings_; }

    /// True when poses move the primitive's vertices on this node.
    static bool moves(const Node&, const Primitive&);

private:
    Result<void> read_primitive(const Node&, const MeshSource&, const Primitive&);
    void keep_fixed(const MeshSource&, const Primitive&, Mesh);
    Result<void> read_skin(int skin);
    void warn(const MeshSource&, const std::vector<std::string>& sentences);

    const Document& document_;
    std::span<const Material> materials_;
    MemoryBudget& budget_;
    std::vector<Mesh> fixed_;
    std::map<const Primitive*, std::uint32_t> fixed_index_;
    std::map<const Primitive*, Streams> moving_;
    std::map<int, std::vector<glm::dmat4>> bind_;
    std::vector<std::string> warnings_;
};

}  // namespace strata::gltf
