// Draws what Dear ImGui made of a frame, by dynamic rendering, into an image of its own that a window shows or the host reads.
// The packaged Vulkan backend of 1.86 wants a render pass and cannot show images of the user's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <imgui.h>

#include "replay/session/session.h"

namespace strata::ui {

/// What an image view shows: float RGBA, rows top to bottom.
struct Texels {
    std::uint32_t width = 0, height = 0;
    std::vector<float> rgba;
};

/// A frame of the inspector: 8 bits a channel, RGB, rows top to bottom.
struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::byte> rgb;
};

enum class Channels : std::uint32_t { color, red, green, blue, alpha, luminance, false_color };
enum class Curve : std::uint32_t { raw, srgb };

/// How texels become colors. Shown as it is (the defaults), display light has the bytes of the PNG that `strata replay` writes.
/// NaN is shown magenta and infinity orange, whatever the look.
struct Look {
    float exposure = 0;  ///< stops
    float black = 0, white = 1;
    Channels channels = Channels::color;
    Curve curve = Curve::srgb;
    friend bool operator==(const Look&, const Look&) = default;
};

/// A texture by number, 0: none.
using TextureId = std::uint32_t;

class LayerDevice;
class LayerTarget;

class ImguiLayer {
public:
    /// Draws into an image alone: no window, no display server. Of the choice only `validation` counts.
    static Result<std::unique_ptr<ImguiLayer>> headless(const DeviceChoice&);
    static Result<std::unique_ptr<ImguiLayer>> on(std::unique_ptr<LayerDevice>);
    virtual ~ImguiLayer() = default;

    /// Replaces a texture, or makes a new one for 0. What is drawn with it from now on shows the new texels.
    virtual TextureId upload(TextureId, const Texels&) = 0;
    virtual void release(TextureId) = 0;
    /// What ImDrawList::AddImage takes to show the texture in this frame.
    virtual ImTextureID shown(TextureId, const Look&) = 0;

    /// Forgets every texture and makes the fonts of the current context one: for an inspector's first frame.
    virtual void begin() = 0;
    /// Forgets what was shown() in the frame before.
    virtual void begin_frame() = 0;
    /// Draws of the frame what differs from the one drawn before; one that nobody looks at need not be drawn.
    virtual Result<void> draw(const ImDrawData&) = 0;
    /// The next frame is drawn whole.
    virtual void forget_drawn() = 0;
    /// The frame drawn last.
    virtual Picture read_back() = 0;

    virtual LayerDevice& device() = 0;
    /// Where the frame was drawn: what a window copies.
    virtual const LayerTarget& target() const = 0;
    /// Validation errors since the last call.
    virtual std::vector<std::string> take_messages() = 0;
};

}  // namespace strata::ui
