// Text of unknown origin as text that can be shown and stored: names and notes of captures, scenes and images.
#pragma once

#include <string>
#include <string_view>

namespace strata {

/// The text as UTF-8 without control characters: each byte that is no part of UTF-8, and each control character but tab and line
/// feed (C0, DEL, C1), becomes U+FFFD. Text without any comes back unchanged.
std::string clean_text(std::string_view);

}  // namespace strata
