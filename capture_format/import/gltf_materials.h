// glTF materials as ours: metallic-roughness, alpha modes, and the extensions KHR_materials_transmission, _unlit,
// _emissive_strength and KHR_texture_transform.
#pragma once

#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "capture_format/frame.h"
#include "capture_format/import/gltf_textures.h"

namespace strata::gltf {

struct ImportedMaterials {
    std::vector<Material> materials;  ///< as in the model, then one for primitives without a material
    std::vector<Texture> textures;
    std::vector<std::string> warnings;
};

ImportedMaterials import_materials(const tinygltf::Model&);

/// A member of an extension object; the fallback when the extension, the member or its type is not there.
double number_in(const tinygltf::ExtensionMap&, const std::string& extension, const std::string& member, double fallback);

}  // namespace strata::gltf
