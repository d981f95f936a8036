// What of a frame can be asked for by name and looked at.
#pragma once

#include <string>
#include <vector>

#include "ui/model.h"

namespace strata::ui {

/// Frame images first, then the views of the chosen techniques.
std::vector<std::string> outputs_of(const Model&);

}  // namespace strata::ui
