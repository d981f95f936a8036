#include "tests/8_rules/source_files.h"

#include <algorithm>
#include <array>
#include <fstream>

namespace strata {
namespace {

constexpr std::array extensions = {".h", ".cpp", ".glsl", ".comp", ".vert", ".geom", ".frag"};

SourceFile read(const std::filesystem::path& root, const std::filesystem::path& path) {
    SourceFile file{path.lexically_relative(root), {}};
    std::ifstream stream(path);
    for (std::string line; std::getline(stream, line);) file.lines.push_back(line);
    return file;
}

std::vector<SourceFile> read_all() {
    const std::filesystem::path root = STRATA_SOURCE_DIR;
    std::vector<SourceFile> files;
    for (const char* folder : {"capture_format", "passes", "replay", "ui", "captures", "tests"}) {
        if (!std::filesystem::exists(root / folder)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
            if (std::ranges::find(extensions, entry.path().extension()) != extensions.end())
                files.push_back(read(root, entry.path()));
    }
    std::ranges::sort(files, {}, &SourceFile::path);
    return files;
}

}  // namespace

const std::vector<SourceFile>& source_files() {
    static const std::vector<SourceFile> files = read_all();
    return files;
}

bool is_header(const SourceFile& file) { return file.path.extension() == ".h"; }

bool is_shader(const SourceFile& file) { return !is_header(file) && file.path.extension() != ".cpp"; }

std::string included(const std::string& line) {
    const std::size_t directive = line.find_first_not_of(' ');
    if (directive == std::string::npos || line.compare(directive, 8, "#include") != 0) return "";
    const std::size_t open = line.find_first_of("\"<", directive), close = line.find_first_of("\">", open + 1);
    return open == std::string::npos || close == std::string::npos ? "" : line.substr(open + 1, close - open - 1);
}

std::string code_of(const std::string& line) {
    // A // inside a string would be cut too: none of our rules looks for what stands behind one.
    return line.substr(0, line.find("//"));
}

}  // namespace strata
