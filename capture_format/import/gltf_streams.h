// The vertices and triangles of a glTF primitive as the file has them: strips and fans unrolled, nothing posed, nothing made up.
#pragma once

#include <string>
#include <vector>

#include "capture_format/frame/mesh.h"
#include "capture_format/import/gltf_document.h"
#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

/// Displacements of a morph target; each is empty or as long as the positions.
struct MorphTarget {
    std::vector<glm::vec3> positions, normals, tangents;
};

struct Streams {
    Mesh mesh;  ///< without normals or tangents where the file has none
    std::vector<MorphTarget> targets;
    std::size_t influences = 0;         ///< joints per vertex: 4 for every JOINTS_n
    std::vector<std::uint32_t> joints;  ///< influences per vertex, into the joints of a skin
    std::vector<float> weights;         ///< as many; a vertex's sum is 1, or 0 where no joint moves it
    std::uint32_t joint_end = 0;        ///< one more than the highest joint that moves anything
    std::vector<std::string> warnings;
};

/// Fails when an accessor is broken or two disagree about the number of vertices. Points and lines become a mesh without
/// triangles.
Result<Streams> read_streams(const Document&, const Primitive&, MemoryBudget&);

}  // namespace strata::gltf
