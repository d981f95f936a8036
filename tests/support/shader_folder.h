// A folder of changed shaders for a test; gone at its end.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace strata {

class ShaderFolder {
public:
    ShaderFolder();
    ShaderFolder(const ShaderFolder&) = delete;
    ~ShaderFolder();

    const std::filesystem::path& path() const { return path_; }
    /// The file as the folder has it, else as it is built in: "passes/shaders/scene.glsl".
    std::string text(std::string_view name) const;
    std::filesystem::path write(std::string_view name, std::string_view text) const;
    /// Every occurrence of some text, of which there must be one; the file's path.
    std::filesystem::path change(std::string_view name, std::string_view from, std::string_view to) const;
    /// As it is built in.
    void restore(std::string_view name) const;

private:
    std::filesystem::path path_;
};

/// Of the first line that contains the part, counted from 1.
std::size_t line_of(std::string_view text, std::string_view part);

}  // namespace strata
