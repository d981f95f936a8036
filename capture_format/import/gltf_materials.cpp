#include "capture_format/import/gltf_materials.h"

#include <algorithm>
#include <cmath>

namespace strata::gltf {
namespace {

/// ((n - 1) / (n + 1))^2 for n = 1.5, what glTF assumes without KHR_materials_ior.
constexpr float head_on_reflectance = 0.04f;

glm::vec3 rgb(const std::vector<double>& values, glm::vec3 fallback) {
    return values.size() < 3 ? fallback : glm::vec3(values[0], values[1], values[2]);
}

glm::dvec2 pair_in(const tinygltf::Value& object, const std::string& member, glm::dvec2 fallback) {
    const tinygltf::Value& pair = object.Get(member);
    if (!pair.IsArray() || pair.ArrayLen() != 2 || !pair.Get(0).IsNumber() || !pair.Get(1).IsNumber()) return fallback;
    return {pair.Get(0).GetNumberAsDouble(), pair.Get(1).GetNumberAsDouble()};
}

/// KHR_texture_transform: offset * rotation * scale. The rotation is counter-clockwise on screen, where v grows downwards, so
/// its matrix is (c, s; -s, c); the matrix printed in the extension's text turns the other way, but its sample asset
/// TextureTransformTest and the viewers that pass it turn this way.
std::array<float, 6> uv_transform(const tinygltf::ExtensionMap& extensions) {
    const auto found = extensions.find("KHR_texture_transform");
    if (found == extensions.end() || !found->second.IsObject()) return {1, 0, 0, 0, 1, 0};
    const glm::dvec2 offset = pair_in(found->second, "offset", glm::dvec2(0));
    const glm::dvec2 scale = pair_in(found->second, "scale", glm::dvec2(1));
    const double angle = number_in(extensions, "KHR_texture_transform", "rotation", 0);
    const double c = std::cos(angle), s = std::sin(angle);
    const std::array<double, 6> rows = {c * scale.x, s * scale.y, offset.x, -s * scale.x, c * scale.y, offset.y};
    std::array<float, 6> transform;
    std::transform(rows.begin(), rows.end(), transform.begin(), [](double value) { return static_cast<float>(value); });
    return transform;
}

/// Turns the materials of one model; textures are shared among them.
class MaterialImport {
public:
    explicit MaterialImport(const tinygltf::Model& model) : model_(model), textures_(model) {}

    ImportedMaterials run() {
        ImportedMaterials result;
        for (const tinygltf::Material& source : model_.materials) result.materials.push_back(convert(source));
        Material plain;  // glTF 2.0, 3.7.2.1: the default material is white and fully metallic
        plain.name = "default";
        plain.metallic = 1;
        result.materials.push_back(plain);
        result.textures = std::move(textures_.textures());
        result.warnings = std::move(warnings_);
        result.warnings.insert(result.warnings.end(), textures_.warnings().begin(), textures_.warnings().end());
        return result;
    }

private:
    /// Works for TextureInfo, NormalTextureInfo and OcclusionTextureInfo, which share no base class.
    template <typename TextureInfo>
    TextureUse use(const TextureInfo& info, Encoding encoding, AlphaUse alpha = AlphaUse::ignored) {
        TextureUse result;
        result.texture = textures_.add(info.index, encoding, alpha);
        const double uv_set = number_in(info.extensions, "KHR_texture_transform", "texCoord", info.texCoord);
        if (uv_set == 1) result.uv_set = 1;
        if (uv_set != 0 && uv_set != 1 && info.index >= 0) {
            warnings_.push_back(fmt::format("texture {} uses uv set {}; only 0 and 1 are read, 0 is used", info.index, uv_set));
        }
        result.transform = uv_transform(info.extensions);
        return result;
    }

    Material convert(const tinygltf::Material& source) {
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        Material material;
        material.name = source.name;
        const bool unlit = source.extensions.contains("KHR_materials_unlit");
        material.lighting_model = unlit ? LightingModel::unlit : LightingModel::ggx;
        set_alpha(material, source);
        material.base_color = glm::vec4(rgb(pbr.baseColorFactor, glm::vec3(1)), 1);
        if (material.alpha_mode != AlphaMode::opaque && pbr.baseColorFactor.size() == 4) {
            material.base_color.w = std::clamp(static_cast<float>(pbr.baseColorFactor[3]), 0.0f, 1.0f);
        }
        material.metallic = std::clamp(static_cast<float>(pbr.metallicFactor), 0.0f, 1.0f);
        material.roughness = std::clamp(static_cast<float>(pbr.roughnessFactor), 0.0f, 1.0f);
        const double strength = number_in(source.extensions, "KHR_materials_emissive_strength", "emissiveStrength", 1);
        material.emissive = rgb(source.emissiveFactor, glm::vec3(0)) * static_cast<float>(strength);
        material.normal_scale = static_cast<float>(source.normalTexture.scale);
        material.occlusion_strength = std::clamp(static_cast<float>(source.occlusionTexture.strength), 0.0f, 1.0f);
        material.double_sided = source.doubleSided;

        const AlphaUse alpha = material.alpha_mode == AlphaMode::opaque ? AlphaUse::ignored : AlphaUse::coverage;
        material.base_color_texture = use(pbr.baseColorTexture, Encoding::srgb, alpha);
        material.metallic_roughness_texture = use(pbr.metallicRoughnessTexture, Encoding::linear);
        material.normal_texture = use(source.normalTexture, Encoding::linear);
        material.emissive_texture = use(source.emissiveTexture, Encoding::srgb);
        material.occlusion_texture = use(source.occlusionTexture, Encoding::linear);
        if (source.extensions.contains("KHR_materials_transmission")) set_transmission(material, source);
        return material;
    }

    void set_alpha(Material& material, const tinygltf::Material& source) {
        if (source.alphaMode == "MASK") material.alpha_mode = AlphaMode::mask;
        if (source.alphaMode == "BLEND") material.alpha_mode = AlphaMode::blend;
        if (source.alphaMode != "MASK" && source.alphaMode != "BLEND" && source.alphaMode != "OPAQUE") {
            warnings_.push_back(
                fmt::format("material '{}' has unknown alpha mode '{}'; it is opaque", source.name, source.alphaMode));
        }
        material.mask_cutoff = static_cast<float>(source.alphaCutoff);
    }

    /// A share F of the diffuse light goes through instead of back (KHR_materials_transmission): the reflected color loses F,
    /// and t = 1 - a (1 - k) with k = color F (1 - 0.04): glass of index 1.5 turns 4 % back even head-on, and without it clear
    /// glass could not be seen at all. Metal transmits nothing. Refraction and rough transmission have no place in a
    /// transmittance.
    void set_transmission(Material& material, const tinygltf::Material& source) {
        double factor = number_in(source.extensions, "KHR_materials_transmission", "transmissionFactor", 0);
        const tinygltf::Value& texture = source.extensions.at("KHR_materials_transmission").Get("transmissionTexture");
        if (texture.IsObject() && texture.Get("index").IsNumber()) {
            factor *= textures_.mean(textures_.add(texture.Get("index").GetNumberAsInt(), Encoding::linear)).x;
            warnings_.push_back(fmt::format("material '{}': the transmission texture is replaced by its mean", source.name));
        }
        factor *= 1 - material.metallic * textures_.mean(material.metallic_roughness_texture.texture).z;
        const float share = std::clamp(static_cast<float>(factor), 0.0f, 1.0f);
        if (share == 0) return;
        if (material.alpha_mode == AlphaMode::mask) {
            warnings_.push_back(fmt::format("material '{}' is masked and transmits; its alpha is coverage", source.name));
        }
        if (material.base_color_texture.texture != no_index) {
            warnings_.push_back(fmt::format("material '{}' transmits the mean of its base color texture", source.name));
        }
        const glm::vec3 color = glm::vec3(material.base_color) * glm::vec3(textures_.mean(material.base_color_texture.texture));
        material.transmission = glm::clamp(color * (share * (1 - head_on_reflectance)), 0.0f, 1.0f);
        material.base_color = glm::vec4(glm::vec3(material.base_color) * (1 - share), material.base_color.w);
        material.alpha_mode = AlphaMode::blend;
    }

    const tinygltf::Model& model_;
    TextureImport textures_;
    std::vector<std::string> warnings_;
};

}  // namespace

ImportedMaterials import_materials(const tinygltf::Model& model) { return MaterialImport(model).run(); }

double number_in(const tinygltf::ExtensionMap& extensions, const std::string& extension, const std::string& member,
                 double fallback) {
    const auto found = extensions.find(extension);
    if (found == extensions.end() || !found->second.IsObject()) return fallback;
    const tinygltf::Value& value = found->second.Get(member);
    return value.IsNumber() ? value.GetNumberAsDouble() : fallback;
}

}  // namespace strata::gltf
