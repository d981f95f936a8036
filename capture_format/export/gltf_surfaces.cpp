#include "capture_format/export/gltf_surfaces.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "capture_format/codec/texture_mips.h"
#include "capture_format/export/gltf_glass.h"
#include "capture_format/export/png.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/texture.h"
#include "capture_format/srgb.h"

namespace strata::to_gltf_parts {
namespace {

bool is_8_bit(const Texture& texture) {
    return texture.format == TextureFormat::rgba8_unorm || texture.format == TextureFormat::rgba8_srgb;
}

Json list(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

/// The finest mip with its texels as glTF will read them; the bytes of colors are converted where the frame keeps them otherwise.
std::vector<std::byte> finest_texels(const Texture& texture, TextureFormat wanted) {
    std::vector<std::byte> texels(texture.texels.begin(),
                                  texture.texels.begin() + std::ptrdiff_t{4} * texture.width * texture.height);
    if (texture.format == wanted) return texels;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        if (i % 4 == 3) continue;  // alpha is linear in both
        const double value = std::to_integer<int>(texels[i]) / 255.0;
        texels[i] = unorm8(wanted == TextureFormat::rgba8_srgb ? encode_srgb(value) : decode_srgb(value));
    }
    return texels;
}

/// Of one axis.
constexpr int wrap_mode(AddressMode mode) {
    return mode == AddressMode::clamp ? 33071 : mode == AddressMode::mirror ? 33648 : 10497;
}

constexpr int nearest_filter = 9728, linear_filter = 9729;
/// Filters with mips: nearest and linear texels of the nearest mip; 2 more where mips are mixed.
constexpr int nearest_of_mips = 9984, linear_of_mips = 9985, mixed = 2;

int mag_filter(const Texture& texture) { return texture.magnify == TexelFilter::nearest ? nearest_filter : linear_filter; }

int min_filter(const Texture& texture) {
    const bool is_nearest = texture.minify == TexelFilter::nearest;
    if (texture.between_mips == MipFilter::none) return is_nearest ? nearest_filter : linear_filter;
    return (is_nearest ? nearest_of_mips : linear_of_mips) + (texture.between_mips == MipFilter::linear ? mixed : 0);
}

/// KHR_texture_transform says offset, rotation and scale; the matrix is (c sx, s sy, tx; -s sx, c sy, ty).
struct Decomposed {
    Json transform;
    bool is_exact = true;  ///< false when the matrix shears
};

Decomposed decomposed(const std::array<float, 6>& m) {
    const double a = m[0], b = m[1], c = m[3], d = m[4];
    const bool is_flat = a == 0 && c == 0;
    const double angle = is_flat ? std::atan2(b, d) : std::atan2(-c, a);
    const double sx = std::hypot(a, c), sy = b * std::sin(angle) + d * std::cos(angle);
    const double shear = std::abs(b - std::sin(angle) * sy) + std::abs(d - std::cos(angle) * sy);
    Json transform = {{"offset", {m[2], m[5]}}, {"rotation", angle}, {"scale", {sx, sy}}};
    return {std::move(transform), shear <= 1e-5 * std::max(std::abs(sy), 1e-5)};  // ten times what floats round off
}

}  // namespace

glm::dvec4 Surfaces::mean(std::uint32_t index) const {
    if (index == no_index || !is_8_bit(frame_.textures[index])) return glm::dvec4(1);
    return glm::dvec4(mean_color(frame_.textures[index]));
}

std::size_t Surfaces::texture(std::uint32_t index, Encoding encoding) {
    const auto [known, fresh] = textures_.try_emplace({index, encoding}, 0);
    if (!fresh) return known->second;
    const Texture& source = frame_.textures[index];
    const TextureFormat wanted = encoding == Encoding::srgb ? TextureFormat::rgba8_srgb : TextureFormat::rgba8_unorm;
    if (source.format != wanted) {
        warnings_.push_back(fmt::format("texture '{}' is {}; its texels are converted with 8 bits", source.name,
                                        encoding == Encoding::srgb ? "linear where glTF has sRGB" : "sRGB where glTF is linear"));
    }
    const std::size_t image = parts_.add(
        "images", {{"name", source.name},
                   {"mimeType", "image/png"},
                   {"bufferView", parts_.add_view(encode_png(source.width, source.height, 4, finest_texels(source, wanted)))}});
    const std::size_t sampler = parts_.add("samplers", {{"magFilter", mag_filter(source)},
                                                        {"minFilter", min_filter(source)},
                                                        {"wrapS", wrap_mode(address_u(source.address))},
                                                        {"wrapT", wrap_mode(address_v(source.address))}});
    known->second = parts_.add("textures", {{"source", image}, {"sampler", sampler}});
    return known->second;
}

void Surfaces::add_texture(Json& parent, const char* name, const TextureUse& use, Encoding encoding) {
    if (use.texture == no_index) return;
    if (!is_8_bit(frame_.textures[use.texture])) {
        warnings_.push_back(
            fmt::format("texture '{}' has floats, which no glTF image holds; it is left out", frame_.textures[use.texture].name));
        return;
    }
    Json reference = {{"index", texture(use.texture, encoding)}};
    if (use.uv_set != 0) reference["texCoord"] = use.uv_set;
    if (use.transform != TextureUse().transform) {
        const Decomposed parts = decomposed(use.transform);
        if (!parts.is_exact) warnings_.push_back("a texture's uv transform shears, which glTF cannot say");
        reference["extensions"]["KHR_texture_transform"] = parts.transform;
        parts_.use("KHR_texture_transform");
    }
    parent[name] = std::move(reference);
}

void Surfaces::add_glass(Json& json, const Material& material) {
    const glm::dvec4 base_mean = mean(material.base_color_texture.texture);
    const Glass glass = glass_of({glm::dvec3(material.base_color), glm::dvec3(material.transmission), glm::dvec3(base_mean)});
    const double dielectric = 1 - static_cast<double>(material.metallic) * mean(material.metallic_roughness_texture.texture).z;
    const double factor = dielectric > 0 ? glass.share / dielectric : 2;
    if (!glass.is_exact || factor > 1 + 1e-6) {
        warnings_.push_back(fmt::format("material '{}' transmits more than glTF can say beside what it reflects", material.name));
    }
    json["pbrMetallicRoughness"]["baseColorFactor"] =
        Json::array({glass.color.x, glass.color.y, glass.color.z, material.base_color.w});
    Json& extensions = json["extensions"];
    extensions["KHR_materials_transmission"] = {{"transmissionFactor", std::min(factor, 1.0)}};
    parts_.use("KHR_materials_transmission");
    if (glass.ior != 1.5) {
        extensions["KHR_materials_ior"] = {{"ior", glass.ior}};
        parts_.use("KHR_materials_ior");
    }
    if (glass.attenuation == glm::dvec3(1)) return;
    // where both faces are drawn each stands for half of the way
    extensions["KHR_materials_volume"] = {{"thicknessFactor", material.double_sided ? 2 : 1},
                                          {"attenuationDistance", 1},
                                          {"attenuationColor", list(glass.attenuation)}};
    parts_.use("KHR_materials_volume");
}

Json Surfaces::material(const Material& material) {
    const glm::vec4& base = material.base_color;
    const bool blends = is_transparent(material.alpha_mode);
    Json pbr = {{"baseColorFactor", {base.x, base.y, base.z, base.w}},
                {"metallicFactor", material.metallic},
                {"roughnessFactor", material.roughness}};
    add_texture(pbr, "baseColorTexture", material.base_color_texture, Encoding::srgb);
    add_texture(pbr, "metallicRoughnessTexture", material.metallic_roughness_texture, Encoding::linear);
    Json json = {{"name", material.name}, {"doubleSided", material.double_sided}, {"pbrMetallicRoughness", std::move(pbr)}};
    add_texture(json, "normalTexture", material.normal_texture, Encoding::linear);
    if (json.contains("normalTexture")) json["normalTexture"]["scale"] = material.normal_scale;
    add_texture(json, "occlusionTexture", material.occlusion_texture, Encoding::linear);
    if (json.contains("occlusionTexture")) json["occlusionTexture"]["strength"] = material.occlusion_strength;
    add_texture(json, "emissiveTexture", material.emissive_texture, Encoding::srgb);
    if (blends) json["alphaMode"] = "BLEND";
    if (material.alpha_mode == AlphaMode::mask) json.update({{"alphaMode", "MASK"}, {"alphaCutoff", material.mask_cutoff}});

    const glm::dvec3 emissive(material.emissive);
    const double brightest = std::max({1.0, emissive.x, emissive.y, emissive.z});
    json["emissiveFactor"] = list(emissive / brightest);
    if (brightest > 1) {
        json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", brightest}};
        parts_.use("KHR_materials_emissive_strength");
    }
    if (material.lighting_model == LightingModel::unlit) {
        json["extensions"]["KHR_materials_unlit"] = Json::object();
        parts_.use("KHR_materials_unlit");
    }
    if (blends && material.transmission != glm::vec3(0)) add_glass(json, material);
    return json;
}

void Surfaces::add_materials() {
    for (const Material& source : frame_.materials) parts_.add("materials", material(source));
}

}  // namespace strata::to_gltf_parts
