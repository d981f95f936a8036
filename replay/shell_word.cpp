#include "replay/shell_word.h"

namespace strata {

std::string shell_word(std::string_view word) {
    std::string safe = "'";
    for (const char c : word) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return safe + "'";
}

std::string as_shell_word(std::string_view word) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,%@";
    return !word.empty() && word.find_first_not_of(plain) == word.npos ? std::string(word) : shell_word(word);
}

}  // namespace strata
