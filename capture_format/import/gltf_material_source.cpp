#include "capture_format/import/gltf_material_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace strata::gltf {
namespace {

/// Reads factors within the ranges of glTF 2.0's schema. What lies beyond is set to the end of its range, with a warning.
class Factors {
public:
    explicit Factors(MaterialSource& material) : material_(&material) {}

    double share(Fields fields, const char* name, double fallback) { return from(fields, name, fallback, {0, 1}); }
    double not_negative(Fields fields, const char* name, double fallback) {
        return from(fields, name, fallback, {0, std::numeric_limits<double>::infinity()});
    }
    /// 0 stands for an infinite index (KHR_materials_ior).
    double ior(Fields fields) {
        const double given = fields.number("ior", 1.5);
        return given == 0 ? 0 : clamped(fields.where() + ".ior", given, {1, std::numeric_limits<double>::infinity()});
    }
    /// Colors up to `brightest`, and alpha.
    std::vector<double> shares(Fields fields, const char* name, std::size_t count, double brightest = 1) {
        std::vector<double> values = fields.numbers(name, count);
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = clamped(fmt::format("{}.{}[{}]", fields.where(), name, i), values[i], {0, i < 3 ? brightest : 1});
        return values;
    }
    glm::dvec3 color(const Fields& fields, const char* name, glm::dvec3 fallback) {
        const std::vector<double> values = shares(fields, name, 3);
        return values.empty() ? fallback : glm::dvec3(values[0], values[1], values[2]);
    }

private:
    struct Range {
        double low, high;
    };

    double from(Fields& fields, const char* name, double fallback, Range range) {
        return clamped(fields.where() + "." + name, fields.number(name, fallback), range);
    }
    double clamped(const std::string& where, double value, Range range) {
        const double used = std::clamp(value, range.low, range.high);
        if (used != value)
            material_->warnings.push_back(fmt::format("{} is {:g}; glTF allows {:g} {}, {:g} is used", where, value, range.low,
                                                      std::isinf(range.high) ? "and more" : fmt::format("to {:g}", range.high),
                                                      used));
        return used;
    }

    MaterialSource* material_;
};

/// KHR_texture_transform: offset * rotation * scale. The rotation is counter-clockwise on screen, where v grows downwards, so
/// its matrix is (c, s; -s, c); the matrix printed in the extension's text turns the other way, but its sample asset
/// TextureTransformTest and the viewers that pass it turn this way.
TextureReference texture(Fields parent, const char* name) {
    Fields fields = parent.object(name);
    TextureReference result;
    result.texture = fields.index("index");
    result.uv_set = fields.size("texCoord", 0);
    Fields transform = fields.object("extensions").object("KHR_texture_transform");
    result.uv_set = transform.size("texCoord", result.uv_set);
    std::vector<double> offset = transform.numbers("offset", 2), scale = transform.numbers("scale", 2);
    if (offset.empty()) offset = {0, 0};
    if (scale.empty()) scale = {1, 1};
    const double angle = transform.number("rotation", 0), c = std::cos(angle), s = std::sin(angle);
    const std::array<double, 6> rows = {c * scale[0], s * scale[1], offset[0], -s * scale[0], c * scale[1], offset[1]};
    std::transform(rows.begin(), rows.end(), result.transform.begin(), [](double value) { return static_cast<float>(value); });
    return result;
}

/// An extension that is ignored, and the member that switches it on: it shows where that is not `off` in every component.
struct Ignored {
    const char *extension, *member;
    double off;
};

constexpr Ignored ignored_extensions[] = {
    {"KHR_materials_anisotropy", "anisotropyStrength", 0},
    {"KHR_materials_clearcoat", "clearcoatFactor", 0},
    {"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor", 0},
    {"KHR_materials_dispersion", "dispersion", 0},
    {"KHR_materials_iridescence", "iridescenceFactor", 0},
    {"KHR_materials_sheen", "sheenColorFactor", 0},
    {"KHR_materials_specular", "specularFactor", 1},
    {"KHR_materials_specular", "specularColorFactor", 1},
};

std::vector<std::string> ignored_in(Fields& extensions) {
    std::vector<std::string> result;
    for (const Ignored& row : ignored_extensions) {
        if (!extensions.has(row.extension)) continue;
        const std::vector<double> values = extensions.object(row.extension).components(row.member);
        const bool shows = std::any_of(values.begin(), values.end(), [&](double value) { return value != row.off; });
        if (shows && (result.empty() || result.back() != row.extension)) result.emplace_back(row.extension);
    }
    return result;
}

void read_volume(MaterialSource& material, Fields& extensions) {
    Factors factors(material);
    Fields transmission = extensions.object("KHR_materials_transmission");
    material.transmits = extensions.has("KHR_materials_transmission");
    material.transmission = factors.share(transmission, "transmissionFactor", 0);
    material.transmission_texture = texture(transmission, "transmissionTexture");
    Fields volume = extensions.object("KHR_materials_volume");
    material.thickness = factors.not_negative(volume, "thicknessFactor", 0);
    material.thickness_texture = texture(volume, "thicknessTexture");
    material.attenuation_distance = factors.not_negative(volume, "attenuationDistance", 0);
    material.attenuation_color = factors.color(volume, "attenuationColor", glm::dvec3(1));
    material.ior = factors.ior(extensions.object("KHR_materials_ior"));
}

}  // namespace

MaterialSource read_material(Fields& fields) {
    MaterialSource material;
    material.name = fields.text("name");
    material.alpha_mode = fields.text("alphaMode", "OPAQUE");
    Factors factors(material);
    material.alpha_cutoff = factors.not_negative(fields, "alphaCutoff", 0.5);
    material.double_sided = fields.flag("doubleSided", false);

    Fields pbr = fields.object("pbrMetallicRoughness");
    // What is unlit shines; our own export writes lamps so.
    material.unlit = fields.object("extensions").has("KHR_materials_unlit");
    const double brightest = material.unlit ? std::numeric_limits<double>::infinity() : 1;
    const std::vector<double> base = factors.shares(pbr, "baseColorFactor", 4, brightest);
    if (!base.empty()) material.base_color = {base[0], base[1], base[2], base[3]};
    material.metallic = factors.share(pbr, "metallicFactor", 1);
    material.roughness = factors.share(pbr, "roughnessFactor", 1);
    material.base_color_texture = texture(pbr, "baseColorTexture");
    material.metallic_roughness_texture = texture(pbr, "metallicRoughnessTexture");
    material.normal_texture = texture(fields, "normalTexture");
    material.normal_scale = fields.object("normalTexture").number("scale", 1);
    material.occlusion_texture = texture(fields, "occlusionTexture");
    material.occlusion_strength = factors.share(fields.object("occlusionTexture"), "strength", 1);
    material.emissive_texture = texture(fields, "emissiveTexture");

    Fields extensions = fields.object("extensions");
    const double strength = factors.not_negative(extensions.object("KHR_materials_emissive_strength"), "emissiveStrength", 1);
    material.emissive = factors.color(fields, "emissiveFactor", glm::dvec3(0)) * strength;
    read_volume(material, extensions);
    material.ignored = ignored_in(extensions);
    return material;
}

bool is_ignored_material_extension(const std::string& extension) {
    return std::any_of(std::begin(ignored_extensions), std::end(ignored_extensions),
                       [&](const Ignored& row) { return extension == row.extension; });
}

}  // namespace strata::gltf
