// "did you mean": the known name closest to what was typed.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace strata {

/// The known name with the smallest edit distance to `typed`, or the first that begins with it. Empty when none is within
/// a third of its length, which is at least one letter and at most half of the word.
std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> known);

/// "; did you mean X?" or empty.
std::string did_you_mean(std::string_view typed, std::span<const std::string_view> known);

}  // namespace strata
