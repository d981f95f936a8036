// The formats a pass may ask for. Sizes and kinds are one table; the device's own names are in replay/gpu/format_table.
#pragma once

#include <cstdint>
#include <string_view>

namespace strata {

enum class Format : std::uint32_t {
    r8_unorm,
    rgba8_unorm,
    r16_unorm,
    rgba16_unorm,
    r16f,
    rg16f,
    rgba16f,
    r11g11b10f,
    r32f,
    rg32f,
    rgba32f,
    r8ui,
    r32ui,
    rg32ui,
    rgba32ui,
    d32f,
};

enum class FormatKind : std::uint32_t { real, integer, depth };

struct FormatRow {
    Format format;
    std::string_view name;
    std::uint32_t bytes;
    std::uint32_t channels;
    FormatKind kind;
};

// clang-format off
constexpr FormatRow format_rows[] = {
    {Format::r8_unorm, "r8_unorm", 1, 1, FormatKind::real},      {Format::rgba8_unorm, "rgba8_unorm", 4, 4, FormatKind::real},
    {Format::r16_unorm, "r16_unorm", 2, 1, FormatKind::real},    {Format::rgba16_unorm, "rgba16_unorm", 8, 4, FormatKind::real},
    {Format::r16f, "r16f", 2, 1, FormatKind::real},              {Format::rg16f, "rg16f", 4, 2, FormatKind::real},
    {Format::rgba16f, "rgba16f", 8, 4, FormatKind::real},        {Format::r11g11b10f, "r11g11b10f", 4, 3, FormatKind::real},
    {Format::r32f, "r32f", 4, 1, FormatKind::real},              {Format::rg32f, "rg32f", 8, 2, FormatKind::real},
    {Format::rgba32f, "rgba32f", 16, 4, FormatKind::real},       {Format::r8ui, "r8ui", 1, 1, FormatKind::integer},
    {Format::r32ui, "r32ui", 4, 1, FormatKind::integer},         {Format::rg32ui, "rg32ui", 8, 2, FormatKind::integer},
    {Format::rgba32ui, "rgba32ui", 16, 4, FormatKind::integer},  {Format::d32f, "d32f", 4, 1, FormatKind::depth},
};
// clang-format on

/// The row of a format; rows stand in the enumerators' order.
constexpr const FormatRow& row(Format format) { return format_rows[static_cast<std::uint32_t>(format)]; }

}  // namespace strata
