// Parts of a thing, one mesh per material.
#pragma once

#include <cstdint>
#include <deque>
#include <utility>

#include "captures/scenarios/frame_builder.h"

namespace strata::scenario {

class Parts {
public:
    explicit Parts(FrameBuilder& builder) : builder_(&builder) {}

    /// The mesh of all parts of this material. The reference holds until draw().
    Mesh& of(std::uint32_t material) {
        for (auto& [known, mesh] : meshes_)
            if (known == material) return mesh;
        return meshes_.emplace_back(material, Mesh{}).second;
    }

    /// Draws all parts, one draw per material, and begins anew.
    void draw(const Pose& place) {
        for (auto& [material, mesh] : meshes_) {
            mesh.name = builder_->frame.materials[material].name;
            builder_->draw(builder_->add(std::move(mesh)), material, place);
        }
        meshes_.clear();
    }

private:
    FrameBuilder* builder_;
    std::deque<std::pair<std::uint32_t, Mesh>> meshes_;  // a deque: adding one moves no other
};

}  // namespace strata::scenario
