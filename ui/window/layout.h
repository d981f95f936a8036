// How much of the window each region takes and which panels are in front: what is kept per user between sessions.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "capture_format/result.h"

namespace strata::ui {

struct Layout {
    float left = 310, right = 330, bottom = 180;  ///< pixels
    int width = 1280, height = 800;               ///< of the window
    std::map<std::string, bool> settings = {};    ///< what people switched on and off, by name
    friend bool operator==(const Layout&, const Layout&) = default;
};

/// Keeps the window's size for the next start, unless panels cannot be used at it.
void remember_size(Layout&, int width, int height);

/// Where it is kept, given $XDG_STATE_HOME and $HOME; nothing where neither is set.
std::optional<std::filesystem::path> layout_file(const char* state_home, const char* home);
/// The defaults where there is none, or it says nothing that makes sense.
Layout read_layout(const std::filesystem::path&);
Result<void> write_layout(const std::filesystem::path&, const Layout&);

}  // namespace strata::ui
