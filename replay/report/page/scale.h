// The scale of errors of display light, as pages show it.
#pragma once

#include <string>

#include "replay/report/ranking.h"

namespace strata {

/// "0.04 % of white, not seen"; another error than of white has no words.
std::string error_words(const RankingError&, double value);
/// The six classes with their colors (plot.css); empty for another error than of white.
std::string scale_html(const RankingError&);
/// A square in the color of its class; empty for another error than of white.
std::string class_square(const RankingError&, double value);

}  // namespace strata
