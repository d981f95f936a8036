#include "ui/picture/picture.h"

#include <algorithm>
#include <cmath>

namespace strata::ui {
namespace {

/// The color channels' finite values, for order statistics: at most a quarter million of them, evenly spread.
std::vector<float> finite_values(const Texels& texels, std::uint32_t channels) {
    constexpr std::size_t most = 1 << 18;
    const std::size_t count = texels.rgba.size() / 4, step = std::max<std::size_t>(1, count / most);
    std::vector<float> values;
    for (std::size_t i = 0; i < count; i += step)
        for (std::size_t c = 0; c < std::min<std::size_t>(channels, 3); ++c)
            if (const float value = texels.rgba[4 * i + c]; std::isfinite(value)) values.push_back(value);
    return values;
}

PictureRange bulk_of(std::vector<float> values) {
    if (values.empty()) return {};
    const auto at = [&](double share) {
        const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
        std::ranges::nth_element(values, place);
        return double{*place};
    };
    return {at(.001), at(.999)};
}

void count_texels(PictureInfo& info) {
    bool any = false;
    for (std::size_t i = 0; i < info.texels.rgba.size(); i += 4) {
        bool nan = false, infinite = false, negative = false;
        for (std::size_t c = 0; c < info.channels(); ++c) {
            const double value = double{info.texels.rgba[i + c]};
            nan |= std::isnan(value);
            infinite |= std::isinf(value);
            negative |= value < 0;
            if (!std::isfinite(value) || c == 3) continue;
            info.range = any ? PictureRange{std::min(info.range.low, value), std::max(info.range.high, value)}
                             : PictureRange{value, value};
            any = true;
        }
        info.nans += nan;
        info.infinities += infinite;
        info.negatives += negative;
    }
}

void fill_histogram(PictureInfo& info) {
    const double width = info.range.high - info.range.low;
    for (std::size_t i = 0; i < info.texels.rgba.size(); i += 4)
        for (std::size_t c = 0; c < std::min<std::size_t>(info.channels(), 3); ++c) {
            const double value = double{info.texels.rgba[i + c]};
            if (!std::isfinite(value)) continue;
            const double place = width > 0 ? (value - info.range.low) / width * double{PictureInfo::bins} : 0;
            ++info.histogram[c][std::min(PictureInfo::bins - 1, static_cast<std::size_t>(place))];
        }
}

}  // namespace

bool PictureInfo::contains(glm::ivec2 texel) const {
    return texel.x >= 0 && texel.y >= 0 && texel.x < static_cast<int>(texels.width) && texel.y < static_cast<int>(texels.height);
}

PictureInfo look_at(std::shared_ptr<const HostImage> image, std::uint32_t layer) {
    PictureInfo info{.image = std::move(image), .layer = layer};
    const Extent& extent = info.image->shape.extent;
    info.texels = {extent.width, extent.height, {}};
    info.texels.rgba.reserve(std::size_t{4} * extent.width * extent.height);
    for (std::uint32_t y = 0; y < extent.height; ++y)
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const glm::dvec4 value = texel(*info.image, x, y, layer);
            for (int c = 0; c < 4; ++c) info.texels.rgba.push_back(static_cast<float>(value[c]));
        }
    count_texels(info);
    info.bulk = bulk_of(finite_values(info.texels, info.channels()));
    fill_histogram(info);
    return info;
}

void ShownPicture::show(const std::shared_ptr<const HostImage>& image, std::uint32_t layer, WorkQueue& host, ImguiLayer& screen) {
    if (job_ && job_->result()) {
        picture_ = **job_->result();
        texture_ = screen.upload(texture_, picture_->texels);
        job_.reset();
    }
    if (!image) return;
    const std::uint32_t layers = image->shape.layers * image->shape.extent.depth;
    layer = std::min(layer, layers - 1);
    if (image == wanted_ && layer == wanted_layer_) return;
    wanted_ = image;
    wanted_layer_ = layer;
    job_ =
        start<std::shared_ptr<const PictureInfo>>(host, [image, layer](Progress&) -> Result<std::shared_ptr<const PictureInfo>> {
            return std::shared_ptr<const PictureInfo>(std::make_shared<PictureInfo>(look_at(image, layer)));
        });
}

}  // namespace strata::ui
