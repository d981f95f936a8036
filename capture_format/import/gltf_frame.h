// The frames of one glTF document: what is the same in all of them, and what the pose at a time makes of it.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "capture_format/import/gltf.h"
#include "capture_format/import/gltf_animation.h"
#include "capture_format/import/gltf_document.h"
#include "capture_format/import/gltf_geometry.h"
#include "capture_format/import/gltf_lights.h"
#include "capture_format/import/gltf_materials.h"
#include "capture_format/import/gltf_nodes.h"
#include "capture_format/import/gltf_view.h"
#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata {

struct Draw;  // capture_format/frame/draw.h

}  // namespace strata

namespace strata::gltf {

class FrameSource {
public:
    FrameSource(Document document, const GltfOptions& options, MemoryBudget budget)
        : document_(std::move(document)), options_(options), budget_(budget) {}
    FrameSource(const FrameSource&) = delete;  // its parts point at each other
    FrameSource& operator=(const FrameSource&) = delete;

    /// Reads everything that is the same in all frames. Call once, first.
    Result<void> read();
    Result<Frame> frame(std::uint32_t index);
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    /// A frame that is being put together.
    struct Making;

    Result<void> check_extensions();
    Result<void> read_animation();
    Making begin(double time, double previous_time) const;
    Result<void> add_draws(Making&);
    Result<void> read_instances();
    Result<void> add_draws(Making&, const Node&, const Primitive&);
    Result<void> add_draw(Making&, const Draw&);
    Result<std::uint32_t> moving_mesh(Making&, const Node&, const Primitive&);
    std::vector<glm::dmat4> joint_matrices(const Making&, const Node&) const;
    glm::dmat4 object_to_world(const std::vector<glm::dmat4>& to_world, const Node&, const Primitive&) const;
    std::optional<View> seen_by_camera(const std::vector<glm::dmat4>& to_world);
    Result<void> frame_everything();
    Result<void> set_view(Making&);
    void set_light(Making&);
    void warn(std::string sentence);

    const Document document_;
    const GltfOptions options_;
    MemoryBudget budget_;
    Hierarchy hierarchy_;
    std::vector<bool> moving_;  ///< nodes that the clip moves, or one of their ancestors
    std::optional<Clip> clip_;
    ImportedMaterials surfaces_;
    std::optional<Geometry> geometry_;
    std::map<const Node*, std::vector<glm::dmat4>> instances_;  ///< of nodes that show a mesh, instance to node
    std::optional<View> framing_;                               ///< of all frames that no camera sees
    std::optional<float> exposure_;                             ///< of all frames: as asked for, or frame 0's
    std::vector<std::string> warnings_;
    std::set<std::string> warned_;
};

}  // namespace strata::gltf
