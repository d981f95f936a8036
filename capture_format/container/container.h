// A capture file: a header, sections that are only ever appended, a directory at the end. Knows nothing of frames.
// The grammar is in container.cpp. A file cut short is read up to the cut; a damaged section is named with its offset.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "capture_format/container/file.h"
#include "capture_format/result.h"

namespace strata {

/// The grammar of header, sections and directory. A newer one is refused.
inline constexpr std::uint32_t container_version = 1;

/// Sections of a type this program does not know are kept and skipped.
enum class SectionType : std::uint32_t { directory, thumbnail, frame, blobs, expect, notes };
std::string_view name(SectionType);

/// One section as its header describes it.
struct Section {
    std::uint64_t offset = 0;  ///< of its header, from the start of the file
    SectionType type = SectionType::directory;
    std::uint32_t version = 0;       ///< of the payload's grammar
    std::uint64_t stored_bytes = 0;  ///< of the payload in the file
    std::uint64_t raw_bytes = 0;     ///< of the payload's content, decompressed; untrusted
    std::uint64_t checksum = 0;      ///< XXH3-64 of the stored bytes
};

/// A capture opened for reading.
class Container {
public:
    /// Fails when it is no capture or a newer one. A file that is cut short opens: see damage().
    static Result<Container> open(const std::filesystem::path&);
    /// The same for a copy of bytes in memory; `name` stands for the path in sentences.
    static Result<Container> open(std::span<const std::byte>, std::string name);

    /// All whole sections in file order, directories among them.
    std::span<const Section> sections() const { return sections_; }
    /// What is wrong with the file as a whole: where it was cut, or that its directory is damaged.
    const std::optional<Error>& damage() const { return damage_; }
    /// The stored bytes of a section after comparing the checksum.
    Result<std::vector<std::byte>> stored(std::size_t section) const;
    /// Every byte of the file: headers are those of the directory, padding is zero, checksums are right. open() believes a
    /// directory whose own checksum is right.
    Result<void> check_bytes() const;
    /// The error of a section with where that is.
    Error located(std::size_t section, const Error&) const;
    /// "smoke.strata: section 2 (blobs) at offset 4096".
    std::string whereabouts(std::size_t section) const;
    const std::string& file_name() const { return name_; }  ///< the path, or what stands for it
    std::uint64_t file_bytes() const { return file_bytes_; }
    std::uint32_t version() const { return version_; }

private:
    using Source = std::variant<ReadableFile, std::vector<std::byte>>;
    Container(Source, std::uint64_t file_bytes, std::string name);
    static Result<Container> read(Container);
    Result<void> read_header();
    Result<bool> read_directory();
    Result<void> scan();
    Result<std::vector<std::byte>> bytes(std::uint64_t offset, std::uint64_t count) const;
    template <typename T>
    Result<T> value(std::uint64_t offset) const;

    Source source_;
    std::uint64_t file_bytes_;
    std::string name_;
    std::uint32_t version_ = 0;
    std::vector<Section> sections_;
    std::optional<Error> damage_;
};

/// What goes into a section.
struct Payload {
    SectionType type = SectionType::notes;
    std::uint32_t version = 1;
    std::span<const std::byte> stored;
    std::uint64_t raw_bytes = 0;
};

/// A capture being written. After an error only what was whole before stays in the file.
class ContainerWriter {
public:
    static Result<ContainerWriter> create(const std::filesystem::path&);
    /// Continues a finished capture: its sections stay as they are, a new directory lists old and new ones.
    static Result<ContainerWriter> extend(const std::filesystem::path&);

    /// Fails (usage) where others deleted the file or wrote to it, too.
    Result<void> add(const Payload&);
    /// Writes the directory. Fails (usage), then with the file complete, where others moved it.
    Result<void> finish();
    const std::string& path() const { return file_.path(); }

private:
    explicit ContainerWriter(GrowingFile file) : file_(std::move(file)) {}

    GrowingFile file_;
    std::vector<Section> sections_;
};

}  // namespace strata
