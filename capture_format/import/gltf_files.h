// Where the bytes of a glTF come from: the file itself (JSON, or a .glb's two chunks), data URIs, and files below the folder
// that the glTF lies in. Nothing else is ever opened: no absolute path, no "..", no link that leaves, no http.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

/// The two parts of a .glb, or the whole of a .gltf as JSON. Both point into what was given.
struct Chunks {
    std::string_view json;
    std::span<const std::byte> binary;  ///< empty when there is none
};
/// Fails when the file begins like a .glb and its lengths do not fit.
Result<Chunks> split_chunks(std::span<const std::byte> file);

/// The bytes of a file, not more than the budget holds.
Result<std::vector<std::byte>> read_file(const std::filesystem::path&, MemoryBudget&);

/// What URIs are resolved against.
class Folder {
public:
    /// No folder: only data URIs are read.
    Folder() = default;
    /// The folder of this file.
    explicit Folder(const std::filesystem::path& file);

    /// The bytes a URI stands for.
    Result<std::vector<std::byte>> read(const std::string& uri, MemoryBudget&) const;

private:
    std::filesystem::path root_;  ///< without links; empty for no folder
};

}  // namespace strata::gltf
