// Which build of a shared library this process has loaded: what tells two drivers apart that state the same version.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace strata {

/// The linker's build ID, in hexadecimal, of the first loaded library with the text in its file's name. Nothing: none is loaded,
/// or it has no ID.
std::optional<std::string> build_of_library(std::string_view name_part);

}  // namespace strata
