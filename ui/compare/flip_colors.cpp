#include "ui/compare/flip_colors.h"

#include <algorithm>

#include "replay/difference/canvas.h"

namespace strata::ui {
namespace {

void add_magma(Texels& texels, double share) {
    const Rgb color = magma(share);
    for (const std::uint8_t byte : {color.x, color.y, color.z}) texels.rgba.push_back(static_cast<float>(byte) / 255);
    texels.rgba.push_back(1);
}

}  // namespace

Texels flip_colors(const HostImage& map, double end) {
    Texels colors{map.shape.extent.width, map.shape.extent.height, {}};
    for (std::uint32_t y = 0; y < colors.height; ++y)
        for (std::uint32_t x = 0; x < colors.width; ++x) add_magma(colors, std::min(texel(map, x, y).x / end, 1.0));
    return colors;
}

void FlipColors::show(const std::shared_ptr<const HostImage>& map, double end, WorkQueue& host, ImguiLayer& layer) {
    if (job_ && job_->result()) {
        if (const auto& made = *job_->result()) texture_ = layer.upload(texture_, *made);
        job_.reset();
    }
    if (!map || job_ || (map == wanted_ && end == end_)) return;
    wanted_ = map;
    end_ = end;
    job_ = start<Texels>(host, [map, end](Progress&) -> Result<Texels> { return flip_colors(*map, end); });
}

TextureId FlipColors::legend(ImguiLayer& layer) {
    if (legend_ != 0) return legend_;
    constexpr std::uint32_t steps = 256;
    Texels colors{steps, 1, {}};
    for (std::uint32_t i = 0; i < steps; ++i) add_magma(colors, static_cast<double>(i) / (steps - 1));
    return legend_ = layer.upload(0, colors);
}

}  // namespace strata::ui
