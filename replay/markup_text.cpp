#include "replay/markup_text.h"

#include <cstdint>

#include "capture_format/clean_text.h"

namespace strata {
namespace {

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? std::uint32_t(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : clean_text(text)) {
        if (c == '&') safe += "&amp;";
        else if (c == '<') safe += "&lt;";
        else if (c == '>') safe += "&gt;";
        else if (c == '"') safe += "&quot;";
        else if (c == '\n') safe += "&#10;";
        else safe += c;
    }
    return safe;
}

std::string png_uri(std::span<const std::byte> png) { return "data:image/png;base64," + base64(png); }

std::string svg_uri(std::string_view svg) { return "data:image/svg+xml;base64," + base64(std::as_bytes(std::span(svg))); }

std::string filled(std::string_view text, const std::map<std::string_view, std::string>& parts) {
    std::string made;
    for (std::size_t at = 0;;) {
        const std::size_t open = text.find("{{", at);
        made += text.substr(at, open - at);
        if (open == std::string_view::npos) return made;
        const std::size_t close = text.find("}}", open);
        made += parts.at(text.substr(open + 2, close - open - 2));
        at = close + 2;
    }
}

}  // namespace strata
