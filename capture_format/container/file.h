// Files as the container needs them: one to read, one that only grows, a lock. Errors carry the path and the system's words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "capture_format/result.h"

namespace strata {

/// A file descriptor, closed when it goes out of scope.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor();
    int number() const { return number_; }

private:
    int number_;
};

/// Fails (bad input) where there is nothing to read, or a pipe, device or folder, which are not opened: a pipe would wait for a
/// writer. /dev/null counts as an empty file.
Result<void> check_is_file(const std::filesystem::path&);

/// A file open for reading. Nothing is mapped: a file that another process shortens gives an error where a mapping gave SIGBUS.
class ReadableFile {
public:
    static Result<ReadableFile> open(const std::filesystem::path&);

    /// These bytes of the file; fails (bad input) where the file ends before them.
    Result<std::vector<std::byte>> read(std::uint64_t offset, std::uint64_t bytes) const;
    std::uint64_t size() const { return size_; }  ///< when it was opened
    const std::string& path() const { return path_; }

private:
    ReadableFile(std::string path, Descriptor descriptor, std::uint64_t size)
        : path_(std::move(path)), descriptor_(std::move(descriptor)), size_(size) {}

    std::string path_;
    Descriptor descriptor_;
    std::uint64_t size_;
};

/// The right to replace a file, which one holder has at a time (flock). It ends with the object or with the process, even one
/// that is killed. A second lock of one file in the same process waits for ever.
class FileLock {
public:
    /// Waits for whoever holds the lock. The previous holder may have replaced the file: the lock is on the new one.
    static Result<FileLock> take(const std::filesystem::path&);
    /// False when somebody replaced the file without taking the lock.
    bool is_current() const;

private:
    FileLock(std::filesystem::path path, Descriptor descriptor) : path_(std::move(path)), descriptor_(std::move(descriptor)) {}

    std::filesystem::path path_;
    Descriptor descriptor_;
};

/// A file written at its end only.
class GrowingFile {
public:
    /// A new file, or an old one emptied. Fails (usage) where another one that was created has this file and is not released; two
    /// would overwrite each other.
    static Result<GrowingFile> create(const std::filesystem::path&);
    /// An existing file, to be continued.
    static Result<GrowingFile> extend(const std::filesystem::path&);

    Result<void> append(std::span<const std::byte>);
    /// Forgets what was appended beyond the size, as far as the file system lets it.
    void cut_back(std::uint64_t size);
    /// Fails (usage) where others wrote to the file, cut it, or deleted it.
    Result<void> check_content() const;
    /// Fails (usage) where the path leads to another file by now, or to none.
    Result<void> check_path() const;
    /// Lets others create it.
    void release();
    std::uint64_t size() const { return size_; }
    const std::string& path() const { return path_; }

private:
    GrowingFile(std::string path, std::filesystem::path place, Descriptor descriptor)
        : path_(std::move(path)), place_(std::move(place)), descriptor_(std::move(descriptor)) {}
    static Result<GrowingFile> open(const std::filesystem::path&, int flags);

    std::string path_;
    std::filesystem::path place_;  ///< absolute: the program may change its folder
    Descriptor descriptor_;
    bool is_file_ = false;  ///< and not a pipe or a device, which have no size
    std::uint64_t size_ = 0;
};

}  // namespace strata
