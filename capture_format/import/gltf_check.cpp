#include "capture_format/import/gltf_check.h"

#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

namespace strata::gltf {
namespace {

/// "2.0" as two numbers.
std::optional<std::pair<int, int>> version_of(std::string_view text) {
    const std::size_t dot = text.find('.');
    if (dot == text.npos) return std::nullopt;
    const auto number = [](std::string_view digits) {
        int value = -1;
        const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return problem == std::errc() && end == digits.data() + digits.size() ? value : -1;
    };
    const std::pair version(number(text.substr(0, dot)), number(text.substr(dot + 1)));
    return version.first < 0 || version.second < 0 ? std::nullopt : std::optional(version);
}

/// Remembers the first reference that leads nowhere.
class ReferenceCheck {
public:
    explicit ReferenceCheck(const Document& document) : document_(document) {}

    Result<void> run() {
        for_all(
            document_.nodes, [this](const std::string& name, const Node& node) { check(name, node); }, "node");
        for_all(
            document_.meshes, [this](const std::string& name, const MeshSource& mesh) { check(name, mesh); }, "mesh");
        for_all(
            document_.materials, [this](const std::string& name, const MaterialSource& material) { check(name, material); },
            "material");
        for (std::size_t i = 0; i < document_.textures.size(); ++i) {
            const std::string name = fmt::format("texture {}", i);
            expect(name, "image", document_.textures[i].image, document_.images.size());
            expect(name, "sampler", document_.textures[i].sampler, document_.samplers.size());
        }
        for (std::size_t i = 0; i < document_.samplers.size(); ++i) check(fmt::format("sampler {}", i), document_.samplers[i]);
        return problem_ ? Result<void>(*problem_) : Result<void>();
    }

private:
    template <typename T, typename Check>
    void for_all(const std::vector<T>& list, const Check& check_one, const char* kind) {
        for (std::size_t i = 0; i < list.size() && !problem_; ++i)
            check_one(fmt::format("{} {} '{:.60}'", kind, i, list[i].name), list[i]);
    }

    void expect(const std::string& where, const char* kind, int index, std::size_t count) {
        if (index < 0 || static_cast<std::size_t>(index) < count) return;
        refuse(within(no_such(kind, index, count), "{place}", where));
    }

    void refuse(Error error) {
        if (!problem_) problem_ = std::move(error);
    }

    void check(const std::string& where, const Node& node) {
        expect(where, "mesh", node.mesh, document_.meshes.size());
        expect(where, "skin", node.skin, document_.skins.size());
        expect(where, "camera", node.camera, document_.cameras.size());
        expect(where, "light", node.light, document_.lights.size());
    }

    void check(const std::string& where, const MeshSource& mesh) {
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const Primitive& primitive = mesh.primitives[i];
            const std::string name = fmt::format("{}, primitive {}", where, i);
            expect(name, "material", primitive.material, document_.materials.size());
            if (primitive.mode <= triangle_fan) continue;
            refuse(fail(Fault::bad_input, "import.gltf.mode", "{place} has mode {mode}; glTF's modes are 0 to {most}", name,
                        primitive.mode, static_cast<std::uint64_t>(triangle_fan)));
        }
    }

    void check(const std::string& where, const MaterialSource& material) {
        for (const TextureReference* use : {&material.base_color_texture, &material.metallic_roughness_texture,
                                            &material.normal_texture, &material.emissive_texture, &material.occlusion_texture,
                                            &material.transmission_texture, &material.thickness_texture})
            expect(where, "texture", use->texture, document_.textures.size());
    }

    void check(const std::string& where, const Sampler& sampler) {
        for (const auto& [name, mode] : {std::pair("wrapS", sampler.wrap_s), std::pair("wrapT", sampler.wrap_t)}) {
            if (mode == repeat || mode == clamp_to_edge || mode == mirrored_repeat) continue;
            refuse(fail(Fault::bad_input, "import.gltf.wrap_mode",
                        "{place} has {member} {mode}, which is not a wrapping mode of glTF", where, name, mode));
        }
        const auto is_filter = [](std::uint64_t filter) { return filter == nearest_filter || filter == linear_filter; };
        const std::uint64_t least = sampler.min_filter;
        const bool has_mips = least >= nearest_mipmap_nearest && least <= linear_mipmap_linear;
        expect_filter(where, "magFilter", sampler.mag_filter, is_filter(sampler.mag_filter));
        expect_filter(where, "minFilter", least, is_filter(least) || has_mips);
    }

    void expect_filter(const std::string& where, std::string_view member, std::uint64_t filter, bool exists) {
        if (exists) return;
        refuse(fail(Fault::bad_input, "import.gltf.filter", "{place} has {member} {filter}, which is not a filter of glTF", where,
                    member, filter));
    }

    const Document& document_;
    std::optional<Error> problem_;
};

}  // namespace

Error no_such(std::string_view list, std::int64_t index, std::size_t count) {
    return fail(Fault::bad_input, "import.gltf.index_range", "{list} {index} does not exist: the glTF has {count}", list, index,
                count);
}

Error not_finite() { return fail(Fault::bad_input, "import.gltf.not_finite", "a number is not finite"); }

Error not_floats(std::uint64_t component_type, std::string_view alternative) {
    return fail(Fault::bad_input, "import.gltf.not_floats",
                "component type {component_type} must be float ({float}){alternative}", component_type,
                static_cast<std::uint64_t>(float32), alternative);
}

Result<void> check_version(const std::string& version, const std::string& least_version) {
    const auto file = version_of(version);
    if (!file || file->first != 2)
        return fail(Fault::bad_input, "import.gltf.version", "the asset version is '{version:.20}', not 2.0", version);
    if (least_version.empty()) return {};
    const auto least = version_of(least_version);
    if (!least)
        return fail(Fault::bad_input, "import.gltf.min_version_syntax",
                    "asset.minVersion is '{version:.20}', which is not a version", least_version);
    if (*least <= std::pair(2, 0)) return {};
    return fail(Fault::bad_input, "import.gltf.min_version", "asset.minVersion is {version}; this program reads glTF 2.0",
                least_version);
}

Result<void> check_references(const Document& document) { return ReferenceCheck(document).run(); }

}  // namespace strata::gltf
