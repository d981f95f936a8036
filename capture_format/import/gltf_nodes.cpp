#include "capture_format/import/gltf_nodes.h"

#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/import/gltf_check.h"

namespace strata::gltf {
namespace {

glm::dmat4 local_matrix(const Node& node, const LocalTransform& transform) {
    if (node.matrix) return *node.matrix;
    glm::dmat4 matrix = glm::translate(glm::dmat4(1), transform.translation);
    if (glm::length(transform.rotation) > 0) matrix *= glm::mat4_cast(glm::normalize(transform.rotation));
    return glm::scale(matrix, transform.scale);
}

/// Walks trees with a stack instead of recursion: a file may nest a million nodes.
class Walk {
public:
    explicit Walk(const Document& document) : document_(document), reached_(document.nodes.size()) {}

    Result<Hierarchy> run() {
        std::vector<bool> is_child(document_.nodes.size());
        for (const Node& node : document_.nodes) {
            for (const int child : node.children) {
                if (exists(child)) is_child[static_cast<std::size_t>(child)] = true;
            }
        }
        std::vector<int> parentless;
        for (std::size_t i = 0; i < document_.nodes.size(); ++i) {
            if (!is_child[i]) parentless.push_back(static_cast<int>(i));
        }
        if (document_.scenes && static_cast<std::size_t>(document_.scene) >= document_.scenes->size() &&
            !document_.scenes->empty()) {
            return no_such("scene", document_.scene, document_.scenes->size());
        }
        // a file without scenes shows every node that is nobody's child
        const bool has_scene = document_.scenes && !document_.scenes->empty();
        const auto& roots = has_scene ? (*document_.scenes)[static_cast<std::size_t>(document_.scene)] : parentless;
        if (const auto walked = from(roots); !walked) return walked.error();
        hierarchy_.shown = hierarchy_.steps.size();
        for (const int root : parentless) {  // joints may be outside the scene
            if (!reached_[static_cast<std::size_t>(root)]) static_cast<void>(from({root}));
        }
        return std::move(hierarchy_);
    }

private:
    bool exists(int node) const { return node >= 0 && static_cast<std::size_t>(node) < document_.nodes.size(); }

    Result<void> from(const std::vector<int>& roots) {
        std::vector<Hierarchy::Step> pending;
        for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.push_back({*root, -1});
        while (!pending.empty()) {
            const Hierarchy::Step next = pending.back();
            pending.pop_back();
            if (!exists(next.node)) {
                return no_such("node", next.node, document_.nodes.size());
            }
            const auto index = static_cast<std::size_t>(next.node);
            if (reached_[index])
                return fail(Fault::bad_input, "import.gltf.node_cycle", "node {node} is reached twice; nodes must form a tree",
                            next.node);
            reached_[index] = true;
            hierarchy_.steps.push_back(next);
            const std::vector<int>& children = document_.nodes[index].children;
            for (auto child = children.rbegin(); child != children.rend(); ++child) pending.push_back({*child, next.node});
        }
        return {};
    }

    const Document& document_;
    std::vector<bool> reached_;
    Hierarchy hierarchy_;
};

}  // namespace

NodePose rest_pose(const Document& document) {
    NodePose pose;
    for (const Node& node : document.nodes) pose.transforms.push_back({node.translation, node.scale, node.rotation});
    pose.weights.resize(document.nodes.size());
    return pose;
}

Result<Hierarchy> walk_nodes(const Document& document) { return Walk(document).run(); }

std::vector<glm::dmat4> to_world(const Document& document, const Hierarchy& hierarchy, const NodePose& pose) {
    std::vector<glm::dmat4> world(document.nodes.size(), glm::dmat4(1));
    for (const Hierarchy::Step& step : hierarchy.steps) {
        const auto node = static_cast<std::size_t>(step.node);
        world[node] = local_matrix(document.nodes[node], pose.transforms[node]);
        if (step.parent >= 0) world[node] = world[static_cast<std::size_t>(step.parent)] * world[node];
    }
    return world;
}

}  // namespace strata::gltf
