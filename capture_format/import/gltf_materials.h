// glTF materials as ours: metallic-roughness, alpha modes, transmission with volume and index of refraction, unlit, emission.
#pragma once

#include <string>
#include <vector>

#include "capture_format/frame/material.h"
#include "capture_format/frame/texture.h"
#include "capture_format/import/gltf_document.h"
#include "capture_format/import/gltf_textures.h"
#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

struct ImportedMaterials {
    std::vector<Material> materials;  ///< as in the document, then one for primitives without a material
    std::vector<Texture> textures;
    std::vector<std::string> warnings;  ///< ignored extensions are named with the number of materials they would change
};

/// Fails when the textures take more memory than the budget has, or one is not taken; what else is wrong with them is a warning.
Result<ImportedMaterials> import_materials(const Document&, MemoryBudget&, const TakeTexture&);

/// ((n - 1) / (n + 1))^2, the share of light that a surface of this index of refraction turns back head-on: 0.04 for 1.5.
double head_on_reflectance(double ior);

}  // namespace strata::gltf
