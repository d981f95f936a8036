// A glTF material as the file says it, with the extensions that mean something to us.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/import/gltf_json.h"

namespace strata::gltf {

/// A use of a texture: TextureInfo and its kin, with KHR_texture_transform.
struct TextureReference {
    int texture = -1;
    std::uint64_t uv_set = 0;
    std::array<float, 6> transform = {1, 0, 0, 0, 1, 0};
};

struct MaterialSource {
    std::string name, alpha_mode;
    glm::dvec4 base_color{1};
    double metallic = 1, roughness = 1, alpha_cutoff = 0.5, normal_scale = 1, occlusion_strength = 1;
    glm::dvec3 emissive{0};  ///< KHR_materials_emissive_strength is in it
    bool double_sided = false, unlit = false, transmits = false;
    TextureReference base_color_texture, metallic_roughness_texture, normal_texture, emissive_texture, occlusion_texture;

    double transmission = 0;  ///< KHR_materials_transmission
    TextureReference transmission_texture;
    double thickness = 0, attenuation_distance = 0;  ///< KHR_materials_volume, meters; no distance means no attenuation
    TextureReference thickness_texture;
    glm::dvec3 attenuation_color{1};
    double ior = 1.5;                        ///< KHR_materials_ior
    std::vector<std::string> ignored;        ///< extensions that would change what it looks like, and do not
    std::vector<std::string> warnings = {};  ///< factors beyond what glTF's schema allows, and what is used instead
};

/// One element of the glTF's materials.
MaterialSource read_material(Fields&);

/// Extensions of materials that are read and then ignored with a warning wherever they would show.
bool is_ignored_material_extension(const std::string& extension);

}  // namespace strata::gltf
