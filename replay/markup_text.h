// Text and pictures in HTML, SVG and XML.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace strata {

/// Pictures in a page take no more bytes than this.
inline constexpr std::size_t page_picture_bytes = 4'000'000;

/// Text in an attribute or an element. XML 1.0 has no control characters and, as declared here, nothing but UTF-8; names of files
/// may have either. In an attribute a line's end would be read as a space.
std::string escaped(std::string_view);

/// A PNG as a URI that holds it.
std::string png_uri(std::span<const std::byte> png);

/// An SVG as a URI that holds it.
std::string svg_uri(std::string_view svg);

/// A template with its {{places}} filled. Every place has a part.
std::string filled(std::string_view text, const std::map<std::string_view, std::string>& parts);

}  // namespace strata
