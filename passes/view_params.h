// The parameters that a debug view depends on: its help names them.
#pragma once

#include <string_view>
#include <vector>

#include "passes/technique.h"

namespace strata {

/// Whether the text has the word, between characters that are no part of one.
bool has_word(std::string_view text, std::string_view word);

std::vector<const Param*> params_of(const Technique&, const DebugView&);

}  // namespace strata
