// The images of a glTF as textures with mips. One glTF texture may become several of ours: the texels of a color
// texture are sRGB, those of a data texture are not.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame.h"
#include "capture_format/import/gltf_budget.h"
#include "capture_format/import/gltf_document.h"
#include "capture_format/result.h"

namespace strata::gltf {

enum class Encoding : std::uint32_t { srgb, linear };
enum class AlphaUse : std::uint32_t { coverage, ignored };  ///< ignored: every texel becomes opaque

/// Decodes images when they are first asked for and remembers them.
class TextureImport {
public:
    TextureImport(const Document& document, Budget& budget) : document_(document), budget_(budget) {}

    /// The index of a texture in textures(); no_index, with a warning, when it cannot be read.
    std::uint32_t add(int gltf_texture, Encoding, AlphaUse = AlphaUse::ignored);
    /// The mean over all texels, linear. 1 for no_index.
    glm::vec4 mean(std::uint32_t texture) const;

    std::vector<Texture>& textures() { return textures_; }
    const std::vector<std::string>& warnings() const { return warnings_; }

private:
    Result<Texture> decode(int image);
    AddressMode address_mode(const TextureSource&);

    const Document& document_;
    Budget& budget_;
    std::map<std::tuple<int, Encoding, AlphaUse>, std::uint32_t> known_;
    std::vector<Texture> textures_;
    std::vector<std::string> warnings_;
};

}  // namespace strata::gltf
