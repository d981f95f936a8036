// JSON as it is printed and written to files.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace strata {

/// Indented, with a line's end. What is no UTF-8, such as the name of a file, is replaced by U+FFFD.
std::string json_text(const nlohmann::ordered_json&);

}  // namespace strata
