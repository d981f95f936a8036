// The choices of an integer parameter: each name beside the constant that C++ and shaders know its value by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace strata {

/// Names of a parameter's values 0 and 1.
inline constexpr std::string_view switches[] = {"off", "on"};

struct ChoiceRow {
    std::uint32_t value = 0;
    std::string_view name;
};

/// The names as Param::choices wants them: by value, from 0. Rows in another order, and values left out or given twice, do not
/// compile.
template <std::size_t count>
consteval std::array<std::string_view, count> choice_names(const ChoiceRow (&rows)[count]) {
    std::array<std::string_view, count> names;
    for (std::size_t i = 0; i < count; ++i) {
        if (rows[i].value != i) throw "a choice is not in the place of its value";
        names[i] = rows[i].name;
    }
    return names;
}

}  // namespace strata
