#include "tests/support/gltf_text.h"

#include <span>
#include <stdexcept>

#include "capture_format/frame/frame.h"

namespace strata {

std::string base64(const std::string& bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        }
        for (std::size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? digits[group >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

std::string showing(const std::string& primitive, const std::string& more) {
    return fmt::format("\"nodes\":[{{\"mesh\":0}}],\"meshes\":[{{\"name\":\"m\",\"primitives\":[{}]}}]{}", primitive, more);
}

std::string with_image(const std::string& image, const std::string& texture_info) {
    Gltf gltf = Gltf().with_triangle();
    gltf.floats({0, 0, 1, 0, 0, 1}, "VEC2", 2);
    return gltf.text(
        showing(R"({"material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}})") +
        fmt::format(R"(,"images":[{{{}}}],"textures":[{{"source":0,"sampler":0}}],"samplers":[{{"wrapS":33071,"wrapT":33071}}],
        "materials":[{{"alphaMode":"BLEND","pbrMetallicRoughness":{{"baseColorTexture":{{"index":0{}}}}}}}])",
                    image, texture_info));
}

GltfScene opened(const std::string& text, const GltfOptions& options) {
    auto scene = GltfScene::open(std::as_bytes(std::span(text)), "test.gltf", options);
    if (!scene) throw std::runtime_error(scene.error().sentence);
    return *std::move(scene);
}

Result<ImportedScene> import_text(const std::string& text, const GltfOptions& options) {
    auto scene = GltfScene::open(std::as_bytes(std::span(text)), "test.gltf", options);
    if (!scene) return scene.error();
    auto frame = scene->frame(0);
    if (!frame) return frame.error();
    return ImportedScene{*std::move(frame), scene->warnings()};
}

ImportedScene imported(const std::string& text, const GltfOptions& options) {
    auto scene = import_text(text, options);
    if (!scene) throw std::runtime_error(scene.error().sentence);
    return *std::move(scene);
}

std::optional<Error> refusal(const std::string& text) {
    const auto scene = import_text(text);
    return scene ? std::optional<Error>() : scene.error();
}

}  // namespace strata
