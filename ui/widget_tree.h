// The widgets of a frame as JSON, and what else says how the inspector stands: what `tree` of a script and Shift+F12 write.
#pragma once

#include <string>

#include "ui/inspector.h"

namespace strata::ui {

/// Of the last frame.
std::string widget_tree(const Inspector&);

}  // namespace strata::ui
