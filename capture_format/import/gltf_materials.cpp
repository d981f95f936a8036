#include "capture_format/import/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "capture_format/import/gltf_surfaces.h"
#include "capture_format/import/gltf_textures.h"

namespace strata::gltf {
namespace {

/// What glTF assumes without KHR_materials_ior.
constexpr double usual_ior = 1.5;

float unit_float(double value) { return std::clamp(static_cast<float>(value), 0.0f, 1.0f); }

/// What of each channel is left after the way through the material (KHR_materials_volume): c^(thickness / distance). The way is
/// the thickness as the file gives it, straight through and not scaled by nodes. Where both faces are drawn a ray meets the
/// material twice, so each face takes half the way.
glm::dvec3 attenuation(const MaterialSource& source, double thickness) {
    if (!(source.attenuation_distance > 0)) return glm::dvec3(1);
    const double way = std::max(thickness, 0.0) * (source.double_sided ? 0.5 : 1.0);
    return glm::pow(glm::clamp(source.attenuation_color, 0.0, 1.0), glm::dvec3(way / source.attenuation_distance));
}

/// Turns the materials of one document; textures are shared among them.
class MaterialImport {
public:
    MaterialImport(const Document& document, MemoryBudget& budget, const TakeTexture& take)
        : document_(document), budget_(budget), textures_(document, budget, take) {}

    Result<ImportedMaterials> run() {
        ImportedMaterials result;
        for (const MaterialSource& source : document_.materials) result.materials.push_back(convert(source));
        if (textures_.problem()) return *textures_.problem();
        Material plain;  // glTF 2.0, 3.7.2.1: the default material is white and fully metallic
        plain.name = "default";
        plain.metallic = 1;
        result.materials.push_back(plain);
        result.textures = std::move(textures_.textures());
        result.warnings = std::move(warnings_);
        for (const auto& [ignored, count] : ignored_) {
            result.warnings.push_back(
                fmt::format("{} is ignored; it would change {} material{}", ignored, count, count == 1 ? "" : "s"));
        }
        result.warnings.insert(result.warnings.end(), textures_.warnings().begin(), textures_.warnings().end());
        return result;
    }

private:
    TextureUse use(const TextureReference& reference, Encoding encoding, AlphaUse alpha = AlphaUse::ignored) {
        TextureUse result;
        result.texture = textures_.add(reference.texture, encoding, alpha);
        result.transform = reference.transform;
        if (reference.uv_set == 1) result.uv_set = 1;
        if (reference.uv_set > 1 && reference.texture >= 0) {
            warnings_.push_back(
                fmt::format("texture {} uses uv set {}; only 0 and 1 are read, 0 is used", reference.texture, reference.uv_set));
        }
        return result;
    }

    Material convert(const MaterialSource& source) {
        Material material;
        material.name = source.name;
        material.lighting_model = source.unlit ? LightingModel::unlit : LightingModel::ggx;
        set_alpha(material, source);
        material.base_color = glm::vec4(glm::vec3(source.base_color), 1);
        if (material.alpha_mode != AlphaMode::opaque) material.base_color.w = unit_float(source.base_color.w);
        material.metallic = unit_float(source.metallic);
        material.roughness = unit_float(source.roughness);
        material.emissive = glm::vec3(source.emissive);
        material.normal_scale = static_cast<float>(source.normal_scale);
        material.occlusion_strength = unit_float(source.occlusion_strength);
        material.double_sided = source.double_sided;

        const AlphaUse alpha = material.alpha_mode == AlphaMode::opaque ? AlphaUse::ignored : AlphaUse::coverage;
        material.base_color_texture = use(source.base_color_texture, Encoding::srgb, alpha);
        material.metallic_roughness_texture = use(source.metallic_roughness_texture, Encoding::linear);
        material.normal_texture = use(source.normal_texture, Encoding::linear);
        material.emissive_texture = use(source.emissive_texture, Encoding::srgb);
        material.occlusion_texture = use(source.occlusion_texture, Encoding::linear);
        if (source.transmits) set_transmission(material, source);
        for (const std::string& extension : source.ignored) ++ignored_[extension];
        warnings_.insert(warnings_.end(), source.warnings.begin(), source.warnings.end());
        if (source.ior != usual_ior) ++ignored_["KHR_materials_ior (but for what goes through)"];
        return material;
    }

    void set_alpha(Material& material, const MaterialSource& source) {
        if (source.alpha_mode == "MASK") material.alpha_mode = AlphaMode::mask;
        if (source.alpha_mode == "BLEND") material.alpha_mode = AlphaMode::blend;
        if (source.alpha_mode != "MASK" && source.alpha_mode != "BLEND" && source.alpha_mode != "OPAQUE") {
            warnings_.push_back(
                fmt::format("material '{}' has unknown alpha mode '{}'; it is opaque", source.name, source.alpha_mode));
        }
        material.mask_cutoff = static_cast<float>(source.alpha_cutoff);
    }

    /// What of the light goes through: a share F of the diffuse light through instead of back (KHR_materials_transmission), and
    /// k = color F (1 - R) A of t = 1 - a (1 - k). The surface turns R of the light back even head-on (4 % for glass of
    /// index 1.5; without it clear glass could not be seen at all), A is what the volume leaves, and metal transmits nothing.
    struct Glass {
        double share = 0;
        glm::dvec3 passes{0};
    };

    /// The texture's value at each point, white where there is none. One image at a time is decoded.
    std::vector<glm::vec4> values(const TextureReference& reference, Encoding encoding, std::span<const SurfacePoint> points) {
        std::vector<glm::vec4> result(points.size(), glm::vec4(1));
        textures_.read(reference.texture, encoding, [&](const Texture& texture) {
            const TexelLookup lookup{&texture, reference.uv_set == 1 ? 1u : 0u, reference.transform};
            for (std::size_t i = 0; i < points.size(); ++i) result[i] = glm::vec4(lookup.at(points[i]));
        });
        return result;
    }

    /// Points of the surfaces that show a material; one where no texture makes them differ.
    std::vector<SurfacePoint> points_of(const MaterialSource& source) const {
        std::vector<SurfacePoint> points;
        for (const TextureReference* reference : {&source.base_color_texture, &source.metallic_roughness_texture,
                                                  &source.transmission_texture, &source.thickness_texture}) {
            if (reference->texture < 0 || !points.empty()) continue;
            for_surface_points(document_, static_cast<int>(&source - document_.materials.data()), budget_,
                               [&](const SurfacePoint& point) { points.push_back(point); });
        }
        if (points.empty()) points.emplace_back();
        return points;
    }

    /// The mean over the surfaces that show the material: of what goes through, not of the thickness, for what goes through falls
    /// exponentially with it.
    Glass mean_glass(const Material& material, const MaterialSource& source) {
        const std::vector<SurfacePoint> points = points_of(source);
        const auto color = values(source.base_color_texture, Encoding::srgb, points);
        const auto metal = values(source.metallic_roughness_texture, Encoding::linear, points);
        const auto transmission = values(source.transmission_texture, Encoding::linear, points);
        const auto thickness = values(source.thickness_texture, Encoding::linear, points);
        const double metallic = static_cast<double>(material.metallic), enters = 1 - head_on_reflectance(source.ior);
        Glass sum;
        double area = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double dielectric = 1 - metallic * static_cast<double>(metal[i].z);
            const double share = std::clamp(source.transmission * static_cast<double>(transmission[i].x) * dielectric, 0.0, 1.0);
            const glm::dvec3 tint = glm::dvec3(source.base_color) * glm::dvec3(color[i]);
            const double deep = source.thickness * static_cast<double>(thickness[i].y);
            sum.share += share * points[i].area;
            sum.passes += tint * attenuation(source, deep) * (share * enters * points[i].area);
            area += points[i].area;
        }
        return {sum.share / area, sum.passes / area};
    }

    void warn_of_means(const Material& material, const MaterialSource& source) {
        const auto warn = [&](bool textured, std::string_view name) {
            if (textured)
                warnings_.push_back(fmt::format(
                    "material '{}': the {} texture is replaced by its mean over the surfaces that show it", source.name, name));
        };
        warn(source.transmission_texture.texture >= 0, "transmission");
        warn(source.thickness_texture.texture >= 0, "thickness");
        if (material.base_color_texture.texture != no_index)
            warnings_.push_back(fmt::format("material '{}' transmits the mean of its base color texture", source.name));
        if (material.alpha_mode == AlphaMode::mask)
            warnings_.push_back(fmt::format("material '{}' is masked and transmits; its alpha is coverage", source.name));
    }

    /// The reflected color loses the share that goes through. Refraction and rough transmission have no place in a transmittance.
    void set_transmission(Material& material, const MaterialSource& source) {
        if (source.transmission == 0) return;
        const Glass glass = mean_glass(material, source);
        if (glass.share == 0) return;
        warn_of_means(material, source);
        material.transmission = glm::vec3(glm::clamp(glass.passes, 0.0, 1.0));
        material.base_color = glm::vec4(glm::vec3(glm::dvec3(source.base_color) * (1 - glass.share)), material.base_color.w);
        material.alpha_mode = AlphaMode::blend;
    }

    const Document& document_;
    const MemoryBudget& budget_;
    TextureImport textures_;
    std::vector<std::string> warnings_;
    std::map<std::string, std::size_t> ignored_;  ///< materials that each ignored extension would change
};

}  // namespace

Result<ImportedMaterials> import_materials(const Document& document, MemoryBudget& budget, const TakeTexture& take) {
    return MaterialImport(document, budget, take).run();
}

double head_on_reflectance(double ior) { return std::pow((ior - 1) / (ior + 1), 2); }

}  // namespace strata::gltf
