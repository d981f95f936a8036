// The images of a glTF as textures with mips. One glTF texture may become several of ours: the texels of a color
// texture are sRGB, those of a data texture are not.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
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

/// Address modes and filters of a glTF sampler.
struct Sampling {
    AddressMode address = AddressMode::repeat;
    TexelFilter magnify = TexelFilter::linear, minify = TexelFilter::linear;
    MipFilter between_mips = MipFilter::linear;
    auto operator<=>(const Sampling&) const = default;
};

/// As GltfOptions::take_texture.
using TakeTexture = std::function<Result<void>(Texture)>;

/// Decodes images when they are first asked for: images of equal bytes that are used in the same way become one texture.
class TextureImport {
public:
    TextureImport(const Document& document, MemoryBudget& budget, const TakeTexture& take)
        : document_(document), budget_(budget), take_(take) {}

    /// The index of a texture in textures(); no_index, with a warning, when it cannot be read.
    std::uint32_t add(int gltf_texture, Encoding, AlphaUse = AlphaUse::ignored);
    /// Shows the finest mip of a texture with all channels to the import itself; nothing when there is none or it cannot be read.
    void read(int gltf_texture, Encoding, const std::function<void(const Texture&)>& visit);

    std::vector<Texture>& textures() { return textures_; }
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Set when the budget does not hold a texture or it was not taken. It is then left out.
    const std::optional<Error>& problem() const { return problem_; }

private:
    using Use = std::tuple<BlobHash, Sampling, Encoding, AlphaUse>;

    /// A part of the budget, until it is destroyed.
    struct Room;
    Result<Texture> decode(int image, Room&);
    Result<Texture> decode_once(int image, Room&);
    Result<void> keep(Texture);
    void leave_out(int gltf_texture, const Error&);
    Result<std::uint32_t> convert(const TextureSource&, Encoding, AlphaUse);
    Sampling sampling(const TextureSource&) const;

    const Document& document_;
    MemoryBudget& budget_;
    const TakeTexture& take_;
    std::map<std::tuple<int, Encoding, AlphaUse>, std::uint32_t> known_;
    std::map<Use, std::uint32_t> converted_;
    std::map<int, Error> broken_;  ///< by image
    std::vector<Texture> textures_;
    std::vector<std::string> warnings_;
    std::optional<Error> problem_;
};

}  // namespace strata::gltf
