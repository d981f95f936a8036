// POSIX files: open, map, append. Writes go straight to the system, so what append() returned for outlives this process.
#include "capture_format/container/file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace strata {
namespace {

std::string system_words() { return std::generic_category().message(errno); }

/// Closes a descriptor when it goes out of scope.
struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
};

}  // namespace

Result<MappedFile> MappedFile::open(const std::filesystem::path& path) {
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (file.number < 0) return fail(Fault::bad_input, "cannot open {}: {}", path.string(), system_words());
    struct stat status {};
    if (::fstat(file.number, &status) != 0) return fail(Fault::bad_input, "cannot read {}: {}", path.string(), system_words());
    if (!S_ISREG(status.st_mode)) return fail(Fault::bad_input, "{} is not a file", path.string());
    const auto size = static_cast<std::size_t>(status.st_size);
    if (size == 0) return MappedFile(path.string(), {});
    void* const mapping = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number, 0);
    if (mapping == MAP_FAILED) return fail(Fault::bad_input, "cannot map {}: {}", path.string(), system_words());
    return MappedFile(path.string(), {static_cast<const std::byte*>(mapping), size});
}

MappedFile::MappedFile(MappedFile&& other) noexcept : path_(std::move(other.path_)), bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

MappedFile::~MappedFile() {
    if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

Result<GrowingFile> GrowingFile::open(const std::filesystem::path& path, int flags) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
    if (descriptor < 0) return fail(Fault::usage, "cannot write {}: {}", path.string(), system_words());
    struct stat status {};
    const bool known = ::fstat(descriptor, &status) == 0;
    return GrowingFile(path.string(), descriptor, known ? static_cast<std::uint64_t>(status.st_size) : 0);
}

Result<GrowingFile> GrowingFile::create(const std::filesystem::path& path) { return open(path, O_CREAT | O_TRUNC); }

Result<GrowingFile> GrowingFile::extend(const std::filesystem::path& path) { return open(path, O_APPEND); }

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

GrowingFile& GrowingFile::operator=(GrowingFile&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    std::swap(size_, other.size_);
    return *this;
}

GrowingFile::~GrowingFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

Result<void> GrowingFile::append(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return fail(Fault::usage, "cannot write {}: {}", path_, system_words());
        size_ += static_cast<std::uint64_t>(written);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return {};
}

void GrowingFile::cut_back(std::uint64_t size) {
    if (::ftruncate(descriptor_, static_cast<off_t>(size)) == 0 &&
        ::lseek(descriptor_, static_cast<off_t>(size), SEEK_SET) >= 0) {
        size_ = size;
    }
}

}  // namespace strata
