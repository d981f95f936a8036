// Whether a text is what a person looks for: the letters they typed occur in it, in whatever case.
#pragma once

#include <algorithm>
#include <cctype>
#include <string_view>

namespace strata::ui {

inline bool is_found_in(std::string_view text, std::string_view wanted) {
    const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return wanted.empty() || !std::ranges::search(text, wanted, same).empty();
}

}  // namespace strata::ui
