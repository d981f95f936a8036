#include "capture_format/clean_text.h"

#include <cstddef>
#include <cstdint>

namespace strata {
namespace {

constexpr std::string_view replacement = "\xef\xbf\xbd";  // U+FFFD

unsigned byte_at(std::string_view text, std::size_t place) { return static_cast<unsigned char>(text[place]); }

/// How many bytes the code point takes that begins the text, 0 where none does (Unicode 15, table 3-7).
std::size_t length_of_code_point(std::string_view text) {
    const unsigned first = byte_at(text, 0);
    if (first < 0x80) return 1;
    if (first < 0xc2 || first > 0xf4) return 0;
    const std::size_t length = first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (text.size() < length) return 0;
    // The second byte's range keeps out long forms, surrogates and what is beyond U+10FFFF.
    const unsigned low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (byte_at(text, 1) < low || byte_at(text, 1) > high) return 0;
    for (std::size_t i = 2; i < length; ++i)
        if (byte_at(text, i) < 0x80 || byte_at(text, i) > 0xbf) return 0;
    return length;
}

bool is_control(std::string_view code_point) {
    const unsigned first = byte_at(code_point, 0);
    if (code_point.size() == 2) return first == 0xc2 && byte_at(code_point, 1) < 0xa0;  // C1: U+0080 to U+009F
    return first == 0x7f || (first < 0x20 && first != '\n' && first != '\t');
}

}  // namespace

std::string clean_text(std::string_view text) {
    std::string clean;
    clean.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = length_of_code_point(text);
        const std::string_view code_point = text.substr(0, length == 0 ? 1 : length);
        clean += length == 0 || is_control(code_point) ? replacement : code_point;
        text.remove_prefix(code_point.size());
    }
    return clean;
}

}  // namespace strata
