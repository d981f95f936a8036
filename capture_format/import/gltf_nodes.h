// The node hierarchy of a glTF: a tree, walked once, and where each node stands in the world for given local transforms.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/import/gltf_document.h"
#include "capture_format/result.h"

namespace strata::gltf {

/// Translation, rotation and scale of a node; nodes with a matrix have that instead.
struct LocalTransform {
    glm::dvec3 translation{0}, scale{1};
    glm::dquat rotation{1, 0, 0, 0};
};

/// What animations change, for every node.
struct NodePose {
    std::vector<LocalTransform> transforms;
    std::vector<std::vector<double>> weights;  ///< of morph targets; empty: those of the node, or else of its mesh
};
NodePose rest_pose(const Document&);

/// Every node, parents before children; the nodes of the active scene come first.
struct Hierarchy {
    struct Step {
        int node = -1, parent = -1;
    };
    std::vector<Step> steps;
    std::size_t shown = 0;  ///< how many of the steps are the active scene's
};
/// Fails when a child or root of the scene does not exist or a node is reached twice (a cycle, say).
Result<Hierarchy> walk_nodes(const Document&);

/// Object to world of every node, by its index.
std::vector<glm::dmat4> to_world(const Document&, const Hierarchy&, const NodePose&);

}  // namespace strata::gltf
