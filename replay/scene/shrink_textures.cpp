#include "replay/scene/shrink_textures.h"

#include <algorithm>
#include <map>

#include <fmt/core.h>

#include "capture_format/codec/texture_bytes.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/texture.h"

namespace strata {
namespace {

std::uint64_t finest_bytes(const Texture& t) { return std::uint64_t{t.width} * t.height * texel_bytes(t.format); }

void drop_finest(Texture& t) {
    t.texels.erase(t.texels.begin(), t.texels.begin() + static_cast<std::ptrdiff_t>(finest_bytes(t)));
    t.width = std::max(1u, t.width / 2);
    t.height = std::max(1u, t.height / 2);
    --t.mips;
}

}  // namespace

std::vector<std::string> shrink_textures(Frame& frame, std::uint64_t budget) {
    std::uint64_t total = 0;
    for (const Texture& t : frame.textures) total += texture_bytes(t);
    std::map<std::size_t, std::uint32_t> dropped;  // mips by texture
    while (total > budget) {
        std::size_t largest = frame.textures.size();
        for (std::size_t i = 0; i < frame.textures.size(); ++i)
            if (frame.textures[i].mips > 1 &&
                (largest == frame.textures.size() || finest_bytes(frame.textures[i]) > finest_bytes(frame.textures[largest])))
                largest = i;
        if (largest == frame.textures.size()) break;
        total -= finest_bytes(frame.textures[largest]);
        drop_finest(frame.textures[largest]);
        ++dropped[largest];
    }
    std::vector<std::string> notes;
    for (const auto& [i, mips] : dropped)
        notes.push_back(fmt::format("texture '{}' is used without its {} finest mips: the device binds {} MiB of texels",
                                    frame.textures[i].name, mips, budget >> 20));
    return notes;
}

}  // namespace strata
