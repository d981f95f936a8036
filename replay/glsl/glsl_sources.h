// The GLSL that shaders are compiled from at run time: the files of a folder before those built into the program. A folder may
// hold all of them or just the one that is being changed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "capture_format/result.h"

namespace strata {

class GlslSources {
public:
    static GlslSources built_in();
    /// The same with the files below folder/passes in their place. Fails when there are none, and when one of them is read by C++
    /// as well (*.shared.h) and is not what the program was built with.
    static Result<GlslSources> of(const std::filesystem::path& folder);

    /// Of everything the shader of that name in a ShaderLibrary is compiled from: its own text and all it includes.
    std::uint64_t hash_of(std::string_view shader) const;
    /// Empty for those built in.
    const std::filesystem::path& folder() const { return folder_; }
    /// Whether a file, "passes/shaders/scene.glsl", comes from the folder.
    bool in_folder(std::string_view name) const;
    /// Writes what does not come from the folder below another one, as passes/...
    Result<void> write_others(const std::filesystem::path& to) const;

private:
    struct File {
        std::string text;
        bool in_folder = false;
    };
    Result<void> read_folder();
    Result<void> read_file(const std::filesystem::path&, const std::string& name);

    std::filesystem::path folder_;
    std::map<std::string, File, std::less<>> files_;  // by name
};

/// The name of a shader's file: "passes/" before its own.
std::string source_name(std::string_view shader);

}  // namespace strata
