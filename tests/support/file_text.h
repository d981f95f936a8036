// The text of a file that a test reads.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace strata {

/// Empty where it cannot be read.
inline std::string file_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace strata
