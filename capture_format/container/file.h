// Files as the container needs them: one mapped for reading, one that only grows. Errors carry the path and the system's words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "capture_format/result.h"

namespace strata {

/// A whole file in memory, read-only. Another process that shortens the file while it is mapped kills this one (SIGBUS):
/// captures are only ever appended to.
class MappedFile {
public:
    static Result<MappedFile> open(const std::filesystem::path&);
    MappedFile(MappedFile&&) noexcept;
    MappedFile& operator=(MappedFile&&) noexcept;
    ~MappedFile();

    std::span<const std::byte> bytes() const { return bytes_; }
    const std::string& path() const { return path_; }

private:
    MappedFile(std::string path, std::span<const std::byte> bytes) : path_(std::move(path)), bytes_(bytes) {}

    std::string path_;
    std::span<const std::byte> bytes_;
};

/// A file written at its end only.
class GrowingFile {
public:
    /// A new file, or an old one emptied.
    static Result<GrowingFile> create(const std::filesystem::path&);
    /// An existing file, to be continued.
    static Result<GrowingFile> extend(const std::filesystem::path&);
    GrowingFile(GrowingFile&&) noexcept;
    GrowingFile& operator=(GrowingFile&&) noexcept;
    ~GrowingFile();

    Result<void> append(std::span<const std::byte>);
    /// Forgets what was appended beyond the size, as far as the file system lets it.
    void cut_back(std::uint64_t size);
    std::uint64_t size() const { return size_; }
    const std::string& path() const { return path_; }

private:
    GrowingFile(std::string path, int descriptor, std::uint64_t size)
        : path_(std::move(path)), descriptor_(descriptor), size_(size) {}
    static Result<GrowingFile> open(const std::filesystem::path&, int flags);

    std::string path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace strata
