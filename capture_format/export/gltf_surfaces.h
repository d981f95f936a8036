// Materials and textures of a frame as those of a glTF.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/export/gltf_parts.h"

namespace strata {

struct Frame;       // capture_format/frame.h
struct Material;    // capture_format/frame/material.h
struct TextureUse;  // capture_format/frame/material.h

}  // namespace strata

namespace strata::to_gltf_parts {

class Surfaces {
public:
    Surfaces(const Frame& frame, Parts& parts) : frame_(frame), parts_(parts) {}

    /// Adds every material in the frame's order, and the textures they use.
    void add_materials();
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    enum class Encoding { srgb, linear };  ///< how glTF reads the texels of a use

    Json material(const Material&);
    void add_glass(Json&, const Material&);
    void add_texture(Json& parent, const char* name, const TextureUse&, Encoding);
    std::size_t texture(std::uint32_t, Encoding);
    glm::dvec4 mean(std::uint32_t texture) const;

    const Frame& frame_;
    Parts& parts_;
    std::map<std::pair<std::uint32_t, Encoding>, std::size_t> textures_;
    std::vector<std::string> warnings_;
};

}  // namespace strata::to_gltf_parts
