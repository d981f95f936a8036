// The parameters of a technique and their values, and the numbers that its shaders count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "capture_format/result.h"

namespace strata {

enum class Scalar : std::uint32_t { real, integer };
enum class Scale : std::uint32_t { linear, logarithmic };

/// A parameter: it is the command line's option, the slider, the sweep range, the JSON key and the help text.
struct Param {
    std::string_view name;
    std::string_view group = {};  ///< heading of this row and those after it, where there are many
    double low = 0, high = 1, fallback = 0;
    std::string_view help;
    Scale scale = Scale::linear;
    std::span<const std::string_view> choices = {};  ///< an integer parameter's values by name, from 0
    Scalar scalar = Scalar::real;                    ///< set by param<>()
    std::size_t offset = 0;                          ///< set by param<>()
};

namespace detail {
template <typename Member>
struct MemberOf;
template <typename Struct, typename Field>
struct MemberOf<Field Struct::*> {
    using Owner = Struct;
    using Type = Field;
};
template <auto Member>
std::size_t offset_of() {
    using Owner = typename MemberOf<decltype(Member)>::Owner;
    const Owner owner{};
    return static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&(owner.*Member)) -
                                    reinterpret_cast<const std::byte*>(&owner));
}
}  // namespace detail

/// Ties a row to the field it sets: a float, an int32 or a uint32.
template <auto Member>
Param param(Param row) {
    using Field = typename detail::MemberOf<decltype(Member)>::Type;
    static_assert(std::is_same_v<Field, float> || std::is_same_v<Field, std::int32_t> || std::is_same_v<Field, std::uint32_t>);
    row.scalar = std::is_same_v<Field, float> ? Scalar::real : Scalar::integer;
    row.offset = detail::offset_of<Member>();
    return row;
}

/// A number the shaders count, with the place of its uint32 in the technique's counter struct.
struct Counter {
    std::string_view name, help;
    bool is_fatal = false;   ///< above 0 the picture is wrong: the run fails
    std::size_t offset = 0;  ///< set by counter<>()
};

template <auto Member>
Counter counter(Counter row) {
    static_assert(std::is_same_v<typename detail::MemberOf<decltype(Member)>::Type, std::uint32_t>);
    row.offset = detail::offset_of<Member>();
    return row;
}

/// The row of what shaders count with passes/shaders/finished.glsl.
inline constexpr Counter unfinished_row = {.name = "unfinished",
                                           .help = "threads whose loops ended before they were done, by the driver or by a bound",
                                           .is_fatal = true};

/// The name of a choice or the number: what Settings::set() reads back as this value.
std::string text_of(const Param&, double value);

/// The values of a technique's parameters, in the order of its rows.
class Settings {
public:
    Settings() = default;
    /// Every parameter at its fallback.
    explicit Settings(std::span<const Param> params);
    explicit Settings(std::vector<Param>&&) = delete;  ///< it keeps the rows where they are

    /// Fails with the range or the known names. Accepts a choice by name or number.
    Result<void> set(std::string_view name, std::string_view value);
    Result<void> set(std::string_view name, double value);
    double get(std::string_view name) const;
    /// "falloff=20": what `--set` accepts.
    std::vector<std::string> lines() const;
    std::span<const Param> params() const { return params_; }

    /// The values as the struct that C++ and GLSL share.
    template <typename Block>
    Block as() const {
        Block block{};
        write(std::as_writable_bytes(std::span(&block, 1)));
        return block;
    }

    friend bool operator==(const Settings& a, const Settings& b) { return a.values_ == b.values_; }

private:
    void write(std::span<std::byte>) const;

    std::span<const Param> params_;
    std::vector<double> values_;
};

}  // namespace strata
