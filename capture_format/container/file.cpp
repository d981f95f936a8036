// POSIX files: open, read, append, lock. Writes go straight to the system, so what append() returned for outlives this process.
#include "capture_format/container/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace strata {
namespace {

std::string system_words() { return std::generic_category().message(errno); }

/// Calls a function of the system again while a signal interrupts it.
template <typename Call>
auto uninterrupted(const Call& call) {
    auto result = call();
    while (result < 0 && errno == EINTR) result = call();
    return result;
}

bool is_same_file(const struct stat& a, const struct stat& b) { return a.st_dev == b.st_dev && a.st_ino == b.st_ino; }

}  // namespace

Descriptor::~Descriptor() {
    if (number_ >= 0) ::close(number_);
}

Result<void> check_is_file(const std::filesystem::path& path) {
    struct stat status {
    }, null{};
    if (::stat(path.c_str(), &status) != 0)
        return fail(Fault::bad_input, "file.cannot_open", "cannot open {file}: {reason}", path.string(), system_words());
    const bool is_null = ::stat("/dev/null", &null) == 0 && is_same_file(status, null);
    return S_ISREG(status.st_mode) || is_null ? Result<void>()
                                              : fail(Fault::bad_input, "file.not_a_file", "{file} is not a file", path.string());
}

Result<ReadableFile> ReadableFile::open(const std::filesystem::path& path) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));  // of a pipe it would wait for a writer
    if (file.number() < 0)
        return fail(Fault::bad_input, "file.cannot_open", "cannot open {file}: {reason}", path.string(), system_words());
    struct stat status {};
    if (::fstat(file.number(), &status) != 0)
        return fail(Fault::bad_input, "file.cannot_read", "cannot read {file}: {reason}", path.string(), system_words());
    if (!S_ISREG(status.st_mode)) return fail(Fault::bad_input, "file.not_a_file", "{file} is not a file", path.string());
    return ReadableFile(path.string(), std::move(file), static_cast<std::uint64_t>(status.st_size));
}

Result<std::vector<std::byte>> ReadableFile::read(std::uint64_t offset, std::uint64_t bytes) const {
    std::vector<std::byte> all(bytes);
    for (std::uint64_t done = 0; done < bytes;) {
        const ssize_t got = uninterrupted(
            [&] { return ::pread(descriptor_.number(), all.data() + done, bytes - done, static_cast<off_t>(offset + done)); });
        if (got < 0) return fail(Fault::bad_input, "file.cannot_read", "cannot read {file}: {reason}", path_, system_words());
        if (got == 0) {
            struct stat now {};
            const bool known = ::fstat(descriptor_.number(), &now) == 0;
            return fail(Fault::bad_input, "file.shortened",
                        "{file} was shortened while it was read: it had {bytes} bytes and has {end} now", path_, size_,
                        known ? static_cast<std::uint64_t>(now.st_size) : offset + done);
        }
        done += static_cast<std::uint64_t>(got);
    }
    return all;
}

Result<FileLock> FileLock::take(const std::filesystem::path& path) {
    for (;;) {
        // Some network file systems lock only what is open for writing.
        const int access = ::access(path.c_str(), W_OK) == 0 ? O_RDWR : O_RDONLY;
        FileLock lock(path, Descriptor(::open(path.c_str(), access | O_CLOEXEC | O_NONBLOCK)));
        if (lock.descriptor_.number() < 0)
            return fail(Fault::usage, "file.cannot_lock", "cannot lock {file}: {reason}", path.string(), system_words());
        if (uninterrupted([&] { return ::flock(lock.descriptor_.number(), LOCK_EX); }) != 0)
            return fail(Fault::usage, "file.cannot_lock", "cannot lock {file}: {reason}", path.string(), system_words());
        if (lock.is_current()) return lock;
    }
}

bool FileLock::is_current() const {
    struct stat locked {
    }, there{};
    return ::fstat(descriptor_.number(), &locked) == 0 && ::stat(path_.c_str(), &there) == 0 && is_same_file(locked, there);
}

Result<GrowingFile> GrowingFile::open(const std::filesystem::path& path, int flags) {
    std::error_code unknown;
    // Named first: without memory for the names no file is made.
    GrowingFile file(path.string(), std::filesystem::absolute(path, unknown), Descriptor(-1));
    // O_APPEND: a file that is cut meanwhile stays too short, as nothing is written behind the cut that would hide it.
    file.descriptor_ = Descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_APPEND | flags, 0666));
    if (file.descriptor_.number() < 0)
        return fail(Fault::usage, "file.cannot_write", "cannot write {file}: {reason}", file.path_, system_words());
    struct stat status {};
    file.is_file_ = ::fstat(file.descriptor_.number(), &status) == 0 && S_ISREG(status.st_mode);
    if (file.is_file_) file.size_ = static_cast<std::uint64_t>(status.st_size);
    return file;
}

Result<GrowingFile> GrowingFile::create(const std::filesystem::path& path) {
    Result<GrowingFile> file = open(path, O_CREAT);
    if (!file || !file->is_file_) return file;
    // Some network file systems have no locks: there both go on, and check_content() notices.
    if (uninterrupted([&] { return ::flock(file->descriptor_.number(), LOCK_EX | LOCK_NB); }) != 0 && errno == EWOULDBLOCK)
        return fail(Fault::usage, "file.in_use", "{file} is being written by another program or recorder; choose another file",
                    file->path_);
    if (::ftruncate(file->descriptor_.number(), 0) != 0)
        return fail(Fault::usage, "file.cannot_write", "cannot write {file}: {reason}", file->path_, system_words());
    file->size_ = 0;
    return file;
}

Result<GrowingFile> GrowingFile::extend(const std::filesystem::path& path) { return open(path, 0); }

Result<void> GrowingFile::check_content() const {
    struct stat now {};
    if (!is_file_ || ::fstat(descriptor_.number(), &now) != 0) return {};
    if (now.st_nlink == 0) return fail(Fault::usage, "file.deleted", "{file} was deleted while it was written", path_);
    if (static_cast<std::uint64_t>(now.st_size) == size_) return {};
    return fail(Fault::usage, "file.changed",
                "another program changed {file} while it was written: it has {bytes} bytes and should have {wanted}", path_,
                static_cast<std::uint64_t>(now.st_size), size_);
}

Result<void> GrowingFile::check_path() const {
    struct stat written {
    }, there{};
    if (!is_file_ || ::fstat(descriptor_.number(), &written) != 0) return {};
    if (::stat(place_.c_str(), &there) == 0 && is_same_file(written, there)) return {};
    return fail(Fault::usage, "file.moved", "{file} was moved or replaced while it was written", path_);
}

void GrowingFile::release() { ::flock(descriptor_.number(), LOCK_UN); }

Result<void> GrowingFile::append(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = uninterrupted([&] { return ::write(descriptor_.number(), bytes.data(), bytes.size()); });
        if (written < 0) return fail(Fault::usage, "file.cannot_write", "cannot write {file}: {reason}", path_, system_words());
        size_ += static_cast<std::uint64_t>(written);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return {};
}

void GrowingFile::cut_back(std::uint64_t size) {
    if (::ftruncate(descriptor_.number(), static_cast<off_t>(size)) == 0) size_ = size;
}

}  // namespace strata
