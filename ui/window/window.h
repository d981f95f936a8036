// A window of the desktop: shows what the layer drew, and brings mouse, keys and dropped files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "ui/window/imgui_layer.h"

namespace strata::ui {

/// Whether the next frame waits for something to happen: nothing moves while nothing is computed and nobody touches it.
enum class Pace { resting, busy };

class Window {
public:
    /// Needs a Context. Fails where there is no display.
    static Result<std::unique_ptr<Window>> open(int width, int height, const DeviceChoice&);
    virtual ~Window() = default;

    virtual ImguiLayer& layer() = 0;
    /// Takes what happened since the last frame; false when the window was closed.
    virtual bool begin_frame(Pace) = 0;
    /// Shows what the layer drew last, if that is not what the window shows.
    virtual Result<void> present() = 0;
    virtual void set_title(const std::string&) = 0;
    /// The file that was dropped on it since the last call, or an empty path.
    virtual std::filesystem::path take_dropped() = 0;
    virtual std::pair<int, int> size() const = 0;
};

}  // namespace strata::ui
