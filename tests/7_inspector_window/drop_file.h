// A file let go of over a window, as file managers do it (XDND, version 5: freedesktop.org/wiki/Specifications/XDND).
#pragma once

#include <filesystem>

namespace strata {

/// At a place of the screen; returns once the window at `title` has taken it. Throws where it does not.
void drop_file(const std::filesystem::path&, const char* title, int x, int y);

}  // namespace strata
