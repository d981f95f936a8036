// A primitive's vertices moved by morph targets and by the joints of a skin, in double.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "capture_format/import/gltf_streams.h"

namespace strata::gltf {

/// What moves the vertices of one draw.
struct Pose {
    std::span<const double> weights;     ///< of the morph targets; missing ones are 0
    std::span<const glm::dmat4> joints;  ///< bind pose to the draw's object space; empty for no skin
};

/// v = sum w_j M_j (v0 + sum m_t d_t): glTF 2.0, 3.7.2.2 and 3.7.3.3. Normals turn by the inverse transpose of the blended
/// matrix. A vertex without weights stays where it is. Needs joint_end joints, or none.
Mesh posed(const Streams&, const Pose&);

}  // namespace strata::gltf
