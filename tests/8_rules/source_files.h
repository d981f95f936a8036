// The project's own files, as the rules read them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace strata {

struct SourceFile {
    std::filesystem::path path;  ///< from the project's root
    std::vector<std::string> lines;
    std::string folder() const { return path.begin()->string(); }  ///< "passes"
};

/// Every C++ and GLSL file of capture_format, passes, replay, ui, captures and tests.
const std::vector<SourceFile>& source_files();
bool is_header(const SourceFile&);
bool is_shader(const SourceFile&);
/// The path of an #include, or empty.
std::string included(const std::string& line);
/// The line without its // comment.
std::string code_of(const std::string& line);

}  // namespace strata
