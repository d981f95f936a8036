// The images of a glTF as textures with mips. One glTF texture may become several of ours: the texels of a color
// texture are sRGB, those of a data texture are not.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/container/blob_store.h"
#include "capture_format/frame/texture.h"
#include "capture_format/import/gltf_document.h"
#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

enum class Encoding : std::uint32_t { srgb, linear };
enum class AlphaUse : std::uint32_t { coverage, ignored };  ///< ignored: every texel becomes opaque

/// Decodes images when they are first asked for and remembers them: images of equal bytes that are used in the same way become
/// one texture.
class TextureImport {
public:
    TextureImport(const Document& document, MemoryBudget& budget) : document_(document), budget_(budget) {}

    /// The index of a texture in textures(); no_index, with a warning, when it cannot be read.
    std::uint32_t add(int gltf_texture, Encoding, AlphaUse = AlphaUse::ignored);
    /// The texels of a texture as they are, for the import itself; null when there is none or it cannot be read.
    const Texture* data(int gltf_texture);

    std::vector<Texture>& textures() { return textures_; }
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Set when the budget does not hold a texture, which is then left out.
    const std::optional<Error>& problem() const { return problem_; }

private:
    using Use = std::tuple<BlobHash, AddressMode, Encoding, AlphaUse>;

    Result<Texture> decode(int image, std::uint64_t bytes_per_texel);
    void leave_out(int gltf_texture, const Error&);
    Result<std::uint32_t> convert(const TextureSource&, Encoding, AlphaUse);
    AddressMode address_mode(const TextureSource&);

    const Document& document_;
    MemoryBudget& budget_;
    std::map<std::tuple<int, Encoding, AlphaUse>, std::uint32_t> known_;
    std::map<Use, std::uint32_t> converted_;
    std::map<int, std::optional<Texture>> data_;  ///< by texture
    std::vector<Texture> textures_;
    std::vector<std::string> warnings_;
    std::optional<Error> problem_;
};

}  // namespace strata::gltf
