// What a comparison says in words and numbers.
#pragma once

#include <string>

#include "ui/compare/compare_pictures.h"

namespace strata::ui {

/// "FLIP 0.0123", or why there is none.
std::string flip_text(const ComparedPictures&);
/// How the error is spread, at which exposures, for whose eyes.
std::string flip_help(const ComparedPictures&);
/// "RMSE 0.00123, 1.2 % of A".
std::string rmse_text(const ComparedPictures&);
/// "worst 0.53 at 12 44, b"; of depth in steps of a float.
std::string worst_text(const ComparedPictures&);
/// "331 of 5184 texels differ".
std::string differing_text(const ComparedPictures&);
/// What is not a number, where, and which texels count as equal; empty where there is neither.
std::string oddities_text(const ComparedPictures&);

/// The least of 1, 2 and 5 times a power of ten that is not below: where a scale ends. 1 for what is not above 0.
double round_up(double most);

}  // namespace strata::ui
