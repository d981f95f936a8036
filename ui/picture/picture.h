// What is known of an image once it is to be looked at: its texels for the screen, its range, its histogram, what in it is no
// number.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "replay/images/host_image.h"
#include "ui/replayer/work_queue.h"
#include "ui/window/imgui_layer.h"

namespace strata::ui {

struct PictureRange {
    double low = 0, high = 1;
};

struct PictureInfo {
    std::shared_ptr<const HostImage> image;
    std::uint32_t layer = 0;
    Texels texels;
    std::size_t nans = 0, infinities = 0, negatives = 0;  ///< texels with such a channel
    PictureRange range;                                   ///< of finite values of the color channels
    PictureRange bulk;                                    ///< the same without the thousandth at either end
    static constexpr std::size_t bins = 96;
    std::array<std::array<std::uint32_t, bins>, 3> histogram{};  ///< red, green, blue (one where it has one) over `range`

    std::uint32_t channels() const { return row(image->shape.format).channels; }
    /// A texel as it is in the image, not as the screen's floats have it.
    glm::dvec4 at(glm::ivec2 texel) const {
        return strata::texel(*image, static_cast<std::uint32_t>(texel.x), static_cast<std::uint32_t>(texel.y), layer);
    }
    bool contains(glm::ivec2 texel) const;
};

PictureInfo look_at(std::shared_ptr<const HostImage>, std::uint32_t layer);

/// Keeps what is shown of an image until what comes next is ready: the window neither waits nor flickers.
class ShownPicture {
public:
    /// Once per frame: the image that is wanted now. The same image costs nothing.
    void show(const std::shared_ptr<const HostImage>&, std::uint32_t layer, WorkQueue&, ImguiLayer&);
    /// The last that was ready; null at first.
    const PictureInfo* picture() const { return picture_ ? picture_.get() : nullptr; }
    /// Whether that is what show() was given last.
    bool is_current() const { return picture_ && picture_->image == wanted_ && picture_->layer == wanted_layer_; }
    TextureId texture() const { return texture_; }
    /// What is finished waits for the next show(), which may never come: nobody waits for that.
    bool is_busy() const { return job_ && !job_->result(); }

private:
    std::shared_ptr<const HostImage> wanted_;
    std::uint32_t wanted_layer_ = 0;
    JobOf<std::shared_ptr<const PictureInfo>> job_;
    std::shared_ptr<const PictureInfo> picture_;
    TextureId texture_ = 0;
};

}  // namespace strata::ui
