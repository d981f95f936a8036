// glTF primitives as triangle meshes: strips and fans unrolled, normals and tangents made where they are missing.
#pragma once

#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "capture_format/frame.h"
#include "capture_format/result.h"

namespace strata::gltf {

struct ImportedMesh {
    Mesh mesh;
    std::vector<std::string> warnings;
};

/// The material decides whether tangents are needed, by which uv, and whether vertex alpha counts. Points and lines become a
/// mesh without triangles.
Result<ImportedMesh> import_primitive(const tinygltf::Model&, const tinygltf::Primitive&, const Material&);

/// One normal per triangle, so vertices are no longer shared. Degenerate triangles get +y.
void make_flat_normals(Mesh&);

/// Tangents along u by the uv gradient, summed over the triangles at each vertex. w makes cross(n, t) w point to smaller v:
/// the "up" of a glTF normal map.
void make_tangents(Mesh&, const TextureUse&);

}  // namespace strata::gltf
