// Reads and writes the container; the grammar stands below.
#include "capture_format/container/container.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <xxhash.h>

// The grammar. Numbers are little-endian, offsets count from the start of the file.
//
//   file      = header section*
//   header    = magic:8  container_version:u32  flags:u32                     flags are 0
//   section   = prefix  byte[stored_bytes]  zero[-stored_bytes mod 8]         so every payload is 8-byte aligned
//   prefix    = "SECT"  type:u32  version:u32  0:u32  stored_bytes:u64  raw_bytes:u64  checksum:u64  seal:u64
//   checksum  = XXH3-64 of the stored bytes
//   seal      = XXH3-64 of the prefix before it
//   directory = entry*  offset:u64  end_magic:8                               the payload of a section of type directory
//   entry     = offset:u64  type:u32  version:u32  stored_bytes:u64  raw_bytes:u64  checksum:u64
//
// The last section of a finished file is a directory; its last 16 bytes, which are the last of the file, say where that
// section begins. Its entries are all sections before it, in order and without gaps, older directories included: that is
// what lets a finished file be extended by appending. Without a directory the sections are found one after the other.
namespace strata {
namespace {

static_assert(std::endian::native == std::endian::little, "captures are little-endian and read in place");

struct Header {
    std::array<char, 8> magic;
    std::uint32_t version, flags;
};
struct Prefix {
    std::array<char, 4> mark;
    std::uint32_t type, version, zero;
    std::uint64_t stored_bytes, raw_bytes, checksum, seal;
};
struct DirectoryEntry {
    std::uint64_t offset;
    std::uint32_t type, version;
    std::uint64_t stored_bytes, raw_bytes, checksum;
};
struct Trailer {
    std::uint64_t offset;
    std::array<char, 8> end_magic;
};
static_assert(sizeof(Header) == 16 && sizeof(Prefix) == 48 && sizeof(DirectoryEntry) == 40 && sizeof(Trailer) == 16);

// Like PNG's: a byte above 127, both line ends and an end-of-file show what a text-mode transfer did to the file.
constexpr std::array<char, 8> magic = {'\x93', 'S', 'T', 'R', '\r', '\n', '\x1a', '\n'};
constexpr std::array<char, 8> end_magic = {'S', 'T', 'R', 'A', 'T', 'E', 'N', 'D'};
constexpr std::array<char, 4> mark = {'S', 'E', 'C', 'T'};

std::uint64_t xxh3(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 7) & ~std::uint64_t{7}; }

/// Where the next section begins.
std::uint64_t end_of(const Section& section) { return section.offset + sizeof(Prefix) + padded(section.stored_bytes); }

template <typename T>
T read_at(std::span<const std::byte> bytes, std::uint64_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

template <typename T>
std::span<const std::byte> bytes_of(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

std::uint64_t seal_of(const Prefix& prefix) { return xxh3(bytes_of(prefix).first(offsetof(Prefix, seal))); }

Error wrong_checksum() {
    return fail(Fault::bad_input, "capture.section.checksum", "the section is damaged: its checksum is wrong");
}

Section section_of(const Prefix& prefix, std::uint64_t offset) {
    return {offset, SectionType{prefix.type}, prefix.version, prefix.stored_bytes, prefix.raw_bytes, prefix.checksum};
}

/// The header that describes the section.
Prefix prefix_of(const Section& section) {
    Prefix prefix = {mark,
                     static_cast<std::uint32_t>(section.type),
                     section.version,
                     0,
                     section.stored_bytes,
                     section.raw_bytes,
                     section.checksum,
                     0};
    prefix.seal = seal_of(prefix);
    return prefix;
}

/// True when `section` lies within `size` bytes. Written so that no sum can wrap.
bool fits(const Section& section, std::uint64_t size) {
    return section.offset <= size && size - section.offset >= sizeof(Prefix) &&
           section.stored_bytes <= size - section.offset - sizeof(Prefix) &&
           padded(section.stored_bytes) <= size - section.offset - sizeof(Prefix);
}

}  // namespace

std::string_view name(SectionType type) {
    constexpr std::string_view names[] = {"directory", "thumbnail", "frame", "blobs", "expect", "notes"};
    const auto index = static_cast<std::size_t>(type);
    return index < std::size(names) ? names[index] : "unknown";
}

Result<Container> Container::open(const std::filesystem::path& path) {
    Result<ReadableFile> file = ReadableFile::open(path);
    if (!file) return file.error();
    const std::uint64_t size = file->size();
    std::string name = file->path();
    return read(Container(*std::move(file), size, std::move(name)));
}

Result<Container> Container::open(std::span<const std::byte> bytes, std::string name) {
    return read(Container(std::vector<std::byte>(bytes.begin(), bytes.end()), bytes.size(), std::move(name)));
}

Container::Container(Source source, std::uint64_t file_bytes, std::string name)
    : source_(std::move(source)), file_bytes_(file_bytes), name_(std::move(name)) {}

Result<Container> Container::read(Container container) {
    if (const Result<void> header = container.read_header(); !header) return header.error();
    const Result<bool> listed = container.read_directory();
    if (!listed) return listed.error();
    if (!*listed)
        if (const Result<void> scanned = container.scan(); !scanned) return scanned.error();
    return container;
}

/// The bytes must lie within file_bytes_.
Result<std::vector<std::byte>> Container::bytes(std::uint64_t offset, std::uint64_t count) const {
    if (const auto* file = std::get_if<ReadableFile>(&source_)) return file->read(offset, count);
    const auto part = std::span(std::get<std::vector<std::byte>>(source_)).subspan(offset, count);
    return std::vector<std::byte>(part.begin(), part.end());
}

template <typename T>
Result<T> Container::value(std::uint64_t offset) const {
    return bytes(offset, sizeof(T)).and_then([](const auto& read) { return read_at<T>(read, 0); });
}

Result<void> Container::read_header() {
    const Result<Header> header = file_bytes_ < sizeof(Header) ? Result<Header>(Header{}) : value<Header>(0);
    if (!header) return header.error();
    if (header->magic != magic)
        return fail(Fault::bad_input, "capture.not_a_capture", "{file} is not a capture: it does not begin like one", name_);
    if (header->version != container_version || header->flags != 0) {
        return fail(
            Fault::bad_input, "capture.container_version",
            "{file} has container version {version} and flags {flags:#x}; this program reads version {readable} without flags",
            name_, header->version, header->flags, container_version);
    }
    version_ = header->version;
    return {};
}

/// False when there is no directory at the end, or none that can be trusted.
Result<bool> Container::read_directory() {
    if (file_bytes_ < sizeof(Header) + sizeof(Prefix) + sizeof(Trailer)) return false;
    const auto trailer = value<Trailer>(file_bytes_ - sizeof(Trailer));
    if (!trailer) return trailer.error();
    if (trailer->end_magic != end_magic || trailer->offset > file_bytes_ - sizeof(Prefix)) return false;
    const auto prefix = value<Prefix>(trailer->offset);
    if (!prefix) return prefix.error();
    const Section directory = section_of(*prefix, trailer->offset);
    if (prefix->mark != mark || prefix->type != 0 || prefix->seal != seal_of(*prefix) || !fits(directory, file_bytes_) ||
        end_of(directory) != file_bytes_ || prefix->stored_bytes < sizeof(Trailer) ||
        (prefix->stored_bytes - sizeof(Trailer)) % sizeof(DirectoryEntry) != 0) {
        return false;
    }
    const auto entries = bytes(trailer->offset + sizeof(Prefix), prefix->stored_bytes);
    if (!entries) return entries.error();
    if (xxh3(*entries) != prefix->checksum) return false;
    std::vector<Section> sections;
    std::uint64_t expected = sizeof(Header);
    for (std::uint64_t at = 0; at < entries->size() - sizeof(Trailer); at += sizeof(DirectoryEntry)) {
        const auto entry = read_at<DirectoryEntry>(*entries, at);
        const Section section = {entry.offset,       SectionType{entry.type}, entry.version,
                                 entry.stored_bytes, entry.raw_bytes,         entry.checksum};
        if (section.offset != expected || !fits(section, trailer->offset)) return false;
        expected = end_of(section);
        sections.push_back(section);
    }
    if (expected != trailer->offset) return false;
    sections.push_back(directory);
    sections_ = std::move(sections);
    return true;
}

/// Finds the whole sections one after the other. What is only half there ends the file.
Result<void> Container::scan() {
    std::uint64_t at = sizeof(Header);
    const auto stop = [&](const Error& why) -> Result<void> {
        damage_ = within(why, "{file} is cut short or overwritten: section {section} at offset {offset} of {bytes} bytes", name_,
                         sections_.size(), at, file_bytes_);
        return {};
    };
    while (at != file_bytes_) {
        if (file_bytes_ - at < sizeof(Prefix))
            return stop(fail(Fault::bad_input, "capture.section.header_cut", "the file ends within the section's header"));
        const auto prefix = value<Prefix>(at);
        if (!prefix) return prefix.error();
        if (prefix->mark != mark || prefix->seal != seal_of(*prefix))
            return stop(fail(Fault::bad_input, "capture.section.header_damaged", "the section's header is damaged"));
        const Section section = section_of(*prefix, at);
        if (!fits(section, file_bytes_)) {
            return stop(fail(Fault::bad_input, "capture.section.cut",
                             "the {kind} section needs {needed_bytes} bytes and ends before", name(section.type),
                             section.stored_bytes));
        }
        const auto payload = bytes(at + sizeof(Prefix), section.stored_bytes);
        if (!payload) return payload.error();
        if (xxh3(*payload) != section.checksum) return stop(wrong_checksum());
        sections_.push_back(section);
        at = end_of(section);
    }
    damage_ = fail(Fault::bad_input, "capture.no_directory",
                   "{file} has no directory: its writer was stopped after section {sections}, or it was cut at offset {offset}",
                   name_, sections_.size(), at);
    return {};
}

Result<std::vector<std::byte>> Container::stored(std::size_t index) const {
    const Section& section = sections_[index];
    auto payload = bytes(section.offset + sizeof(Prefix), section.stored_bytes);
    if (payload && xxh3(*payload) != section.checksum) return located(index, wrong_checksum());
    return payload;
}

Result<void> Container::check_bytes() const {
    for (std::size_t i = 0; i < sections_.size(); ++i) {
        const Section& section = sections_[i];
        const auto header = bytes(section.offset, sizeof(Prefix));
        if (!header) return header.error();
        const Prefix expected = prefix_of(section);
        if (!std::ranges::equal(*header, bytes_of(expected)))
            return located(i, fail(Fault::bad_input, "capture.section.header",
                                   "the section is damaged: its header is not the one in the directory"));
        if (const auto payload = stored(i); !payload) return payload.error();
        const std::uint64_t end = section.offset + sizeof(Prefix) + section.stored_bytes;
        const auto padding = bytes(end, end_of(section) - end);
        if (!padding) return padding.error();
        if (std::ranges::any_of(*padding, [](std::byte byte) { return byte != std::byte{0}; }))
            return located(i, fail(Fault::bad_input, "capture.section.padding",
                                   "the section is damaged: the padding behind it is not zero"));
    }
    return {};
}

Error Container::located(std::size_t index, const Error& error) const {
    const Section& section = sections_[index];
    return within(error, "{file}: section {section} ({kind}) at offset {offset}", name_, index, name(section.type),
                  section.offset);
}

std::string Container::whereabouts(std::size_t index) const {
    return fmt::format("{}: section {} ({}) at offset {}", name_, index, name(sections_[index].type), sections_[index].offset);
}

Result<ContainerWriter> ContainerWriter::create(const std::filesystem::path& path) {
    Result<GrowingFile> file = GrowingFile::create(path);
    if (!file) return file.error();
    const Header header = {magic, container_version, 0};
    if (const Result<void> written = file->append(bytes_of(header)); !written) return written.error();
    return ContainerWriter(*std::move(file));
}

Result<ContainerWriter> ContainerWriter::extend(const std::filesystem::path& path) {
    const Result<Container> old = Container::open(path);
    if (!old) return old.error();
    if (old->damage()) return *old->damage();
    Result<GrowingFile> file = GrowingFile::extend(path);
    if (!file) return file.error();
    ContainerWriter writer(*std::move(file));
    writer.sections_.assign(old->sections().begin(), old->sections().end());
    return writer;
}

Result<void> ContainerWriter::add(const Payload& payload) {
    if (const auto unchanged = file_.check_content(); !unchanged) return unchanged;
    const Section section = {.offset = file_.size(),
                             .type = payload.type,
                             .version = payload.version,
                             .stored_bytes = payload.stored.size(),
                             .raw_bytes = payload.raw_bytes,
                             .checksum = xxh3(payload.stored)};
    const Prefix prefix = prefix_of(section);
    constexpr std::array<std::byte, 8> zeros{};
    const std::span<const std::byte> padding = std::span(zeros).first(padded(section.stored_bytes) - section.stored_bytes);
    sections_.push_back(section);  // before it is written: with the section in the file nothing can fail any more
    for (const std::span<const std::byte> part : {bytes_of(prefix), payload.stored, padding}) {
        if (const Result<void> written = file_.append(part); !written) {
            file_.cut_back(section.offset);
            sections_.pop_back();
            return written.error();
        }
    }
    return {};
}

Result<void> ContainerWriter::finish() {
    std::vector<std::byte> directory;
    const auto append = [&](std::span<const std::byte> bytes) { directory.insert(directory.end(), bytes.begin(), bytes.end()); };
    for (const Section& section : sections_) {
        const DirectoryEntry entry = {section.offset,    static_cast<std::uint32_t>(section.type),
                                      section.version,   section.stored_bytes,
                                      section.raw_bytes, section.checksum};
        append(bytes_of(entry));
    }
    const Trailer trailer = {file_.size(), end_magic};
    append(bytes_of(trailer));
    const Payload payload = {.type = SectionType::directory, .version = 1, .stored = directory, .raw_bytes = directory.size()};
    if (const auto added = add(payload); !added) return added;
    if (const auto unchanged = file_.check_content(); !unchanged) return unchanged;
    file_.release();
    return file_.check_path();
}

}  // namespace strata
