// Makes what a glTF mesh lacks: normals, tangents, and uvs that its material reads.
#pragma once

#include <string>
#include <vector>

#include "capture_format/frame/mesh.h"

namespace strata {

struct Material;    // capture_format/frame/material.h
struct TextureUse;  // capture_format/frame/material.h

}  // namespace strata

namespace strata::gltf {

struct FinishedMesh {
    Mesh mesh;
    std::vector<std::string> warnings;
};

/// The material decides whether tangents are needed, by which uv, and whether vertex alpha counts.
FinishedMesh finish_mesh(Mesh, const Material&);

/// One normal per triangle, so vertices are no longer shared. Degenerate triangles get +y.
void make_flat_normals(Mesh&);

/// Tangents along u by the uv gradient, summed over the triangles at each vertex. w makes cross(n, t) w point to smaller v:
/// the "up" of a glTF normal map.
void make_tangents(Mesh&, const TextureUse&);

}  // namespace strata::gltf
