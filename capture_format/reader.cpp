// Opens the container, takes stock of its sections, decodes frames on demand. What a frame means is decided elsewhere.
#include "capture_format/reader.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

#include <xxhash.h>

#include "capture_format/clean_text.h"
#include "capture_format/codec/decode_frame.h"
#include "capture_format/codec/frame_delta.h"
#include "capture_format/codec/upgrade.h"
#include "capture_format/container/blob_store.h"
#include "capture_format/container/container.h"
#include "capture_format/container/picture.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/texture.h"
#include "capture_format/out_of_memory.h"

namespace strata {

struct Capture::Contents {
    Container container;
    MemoryBudget budget;
    std::optional<BlobStore> blobs;   ///< refers to container and budget, so it opens when these have their place
    std::optional<BlobStore> images;  ///< of the expectations, opened when the first is asked for
    std::mutex decoding;              ///< frame() fills and empties what follows and the blob store
    FrameChain chain;
    std::uint64_t chain_bytes = 0;        ///< of the budget
    std::optional<std::size_t> unpacked;  ///< the frame the chain ends with
    std::vector<std::byte> plain;         ///< the frame of version 1 that was asked for last
    std::vector<std::size_t> frames;      ///< section numbers
    std::string id;
    CaptureSummary summary;
    Texture thumbnail;
    std::vector<std::string> expectations;

    Contents(Container opened, std::uint64_t memory_budget) : container(std::move(opened)), budget(memory_budget) {}
    Result<void> read(Partial);
    void summarize();
    static bool is_known(const Section&);
    Result<void> take(std::size_t section);
    Result<void> take_frame(std::size_t section);
    Result<std::span<const std::byte>> flatbuffer(std::size_t frame);
    Result<void> unpack(std::size_t frame);
    Result<std::string> text(std::size_t section, std::size_t longest) const;
    Result<Frame> decoded(std::size_t frame);
    Result<std::vector<std::byte>> expected_image(std::string_view name, std::uint64_t bytes);
};

namespace {

/// XXH3-128 over what frames and blobs sections are, checksums included, in file order.
std::string identify(std::span<const Section> sections) {
    std::vector<std::uint64_t> words;
    for (const Section& section : sections) {
        if (section.type != SectionType::frame && section.type != SectionType::blobs) continue;
        const std::uint64_t kind = static_cast<std::uint64_t>(section.type) << 32 | section.version;
        words.insert(words.end(), {kind, section.stored_bytes, section.raw_bytes, section.checksum});
    }
    const XXH128_hash_t hash = XXH3_128bits(words.data(), words.size() * sizeof(std::uint64_t));
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace

Result<std::string> Capture::Contents::text(std::size_t number, std::size_t longest) const {
    const auto stored = container.stored(number);
    if (!stored) return stored.error();
    if (stored->size() > longest) {
        return container.located(number, fail(Fault::bad_input, "capture.section.too_long",
                                              "the section has {bytes} bytes; the limit is {most}", stored->size(), longest));
    }
    return std::string(reinterpret_cast<const char*>(stored->data()), stored->size());
}

Result<void> Capture::Contents::take_frame(std::size_t number) {
    const Section& section = container.sections()[number];
    if (const auto known = check_format_version(section.version); !known) return container.located(number, known.error());
    summary.format_version = std::max(summary.format_version, section.version);
    frames.push_back(number);
    return {};
}

/// Whether take() knows what the section's bytes mean. Other types and versions were written by a newer program.
bool Capture::Contents::is_known(const Section& section) {
    switch (section.type) {
        case SectionType::thumbnail:
            return section.version >= 1 && section.version <= picture_version;
        case SectionType::notes:
            return section.version == notes_version;
        case SectionType::expect:
            return section.version == expect_version || section.version == expect_images_version;
        case SectionType::directory:
        case SectionType::frame:
        case SectionType::blobs:
            return true;  // a frame without its own bytes is none: their versions are errors, elsewhere
    }
    return false;
}

/// Takes stock of one section that is known.
Result<void> Capture::Contents::take(std::size_t number) {
    const Section& section = container.sections()[number];
    if (section.type == SectionType::frame) return take_frame(number);
    if (section.type == SectionType::thumbnail) {
        const auto stored = container.stored(number);
        if (!stored) return stored.error();
        Result<Texture> picture = decode_picture(*stored, section.version);
        if (!picture) return container.located(number, picture.error());
        thumbnail = *std::move(picture);
    }
    if (section.type == SectionType::notes) {
        Result<std::string> notes = text(number, longest_notes);
        if (!notes) return notes.error();
        summary.notes = clean_text(*notes);
    }
    if (section.type == SectionType::expect && section.version == expect_version) {
        Result<std::string> expectation = text(number, longest_expectation);
        if (!expectation) return expectation.error();
        expectations.push_back(*std::move(expectation));
    }
    return {};
}

/// Adds the next frame to the chain.
Result<void> Capture::Contents::unpack(std::size_t frame) {
    const std::size_t number = frames[frame];
    const Section& section = container.sections()[number];
    unpacked.reset();
    if (section.raw_bytes > largest_frame_section)
        return container.located(
            number, fail(Fault::bad_input, "capture.frame.too_large", "the frame has {bytes} bytes; the limit is {most}",
                         section.raw_bytes, largest_frame_section));
    const std::uint64_t needed = section.raw_bytes * chain_bytes_per_byte;
    if (const auto room = budget.has_room(needed + section.stored_bytes, 1, container.whereabouts(number)); !room) return room;
    const auto stored = container.stored(number);
    if (!stored) return stored.error();
    if (section.version == 1)
        return container.located(
            number, fail(Fault::bad_input, "capture.frame.base_version", "frames of format version 1 cannot be built on"));
    budget.give_back(std::exchange(chain_bytes, 0));
    if (const auto taken = budget.take(needed, 1, container.whereabouts(number)); !taken) return taken;
    chain_bytes = needed;
    const auto raw = chain.unpack(*stored, section.raw_bytes);
    if (!raw) return container.located(number, raw.error());
    unpacked = frame;
    return {};
}

/// The flatbuffer of a frame, and to that end those of the frames it builds on.
Result<std::span<const std::byte>> Capture::Contents::flatbuffer(std::size_t frame) {
    const std::size_t number = frames[frame];
    auto stored = container.stored(number);
    if (!stored) return stored.error();
    if (container.sections()[number].version == 1) {
        plain = *std::move(stored);
        return std::span<const std::byte>(plain);
    }
    const Result<std::uint32_t> reach = FrameChain::reach(*stored);
    if (!reach) return container.located(number, reach.error());
    if (*reach > frame) {
        return container.located(number,
                                 fail(Fault::bad_input, "capture.frame.too_few_before",
                                      "the frame builds on {reach} frames before it; the file has {frames}", *reach, frame));
    }
    std::size_t next = frame - *reach;
    if (unpacked && *unpacked >= next && *unpacked <= frame) next = *unpacked + 1;
    for (; next <= frame; ++next) {
        const Result<void> done = unpack(next);
        if (!done && next < frame) return advised(done.error(), "frame {frame} builds on it", frame);
        if (!done) return done.error();
    }
    return chain.newest();
}

void Capture::Contents::summarize() {
    summary.container_version = container.version();
    if (frames.empty()) summary.format_version = format_version;
    summary.file_bytes = container.file_bytes();
    summary.blob_bytes_stored = blobs->stored_bytes();
    summary.blob_bytes_raw = blobs->raw_bytes();
    summary.frames = frames.size();
    summary.blobs = blobs->size();
    summary.cut_short = container.damage().has_value();
}

Result<void> Capture::Contents::read(Partial partial) {
    Result<BlobStore> opened = BlobStore::open(container, budget);
    if (!opened) return opened.error();
    blobs = *std::move(opened);
    for (std::size_t i = 0; i < container.sections().size(); ++i) {
        const Section& section = container.sections()[i];
        if (!is_known(section)) {
            summary.left_out.push_back(fmt::format("{} has type {} in version {}, which this program does not know: skipped",
                                                   container.whereabouts(i), static_cast<std::uint32_t>(section.type),
                                                   section.version));
            continue;
        }
        const Result<void> taken = take(i);
        // Without its notes, picture or expectations a capture still holds its frames.
        const bool is_dispensable = partial == Partial::allowed && section.type != SectionType::frame;
        if (!taken && !is_dispensable) return taken;
        if (!taken) summary.left_out.push_back(taken.error().sentence + ": left out");
    }
    if (container.damage()) summary.left_out.push_back(container.damage()->sentence + ": what follows is left out");
    summarize();
    id = identify(container.sections());
    return {};
}

Result<Capture> Capture::open(const std::filesystem::path& path, Partial partial, std::uint64_t memory_budget) {
    return within_memory("read", path.native(), [&] { return read(Container::open(path), partial, memory_budget); });
}

Result<Capture> Capture::open(std::span<const std::byte> bytes, std::string name, Partial partial, std::uint64_t memory_budget) {
    return within_memory("read", name, [&] { return read(Container::open(bytes, name), partial, memory_budget); });
}

Result<Capture> Capture::read(Result<Container> container, Partial partial, std::uint64_t memory_budget) {
    if (!container) return container.error();
    if (container->damage() && partial == Partial::refused) {
        return advised(*container->damage(),
                       "pass --allow-partial to replay, info or export to read the complete frames before it");
    }
    auto contents = std::make_unique<Contents>(*std::move(container), memory_budget);
    if (const Result<void> read = contents->read(partial); !read) return read.error();
    return Capture(std::move(contents));
}

Capture::Capture(std::unique_ptr<Contents> contents) : contents_(std::move(contents)) {}
Capture::Capture(Capture&&) noexcept = default;
Capture& Capture::operator=(Capture&&) noexcept = default;
Capture::~Capture() = default;

std::size_t Capture::frame_count() const { return contents_->frames.size(); }
const std::string& Capture::id() const { return contents_->id; }
const CaptureSummary& Capture::summary() const { return contents_->summary; }
const Texture& Capture::thumbnail() const { return contents_->thumbnail; }
const std::vector<std::string>& Capture::expectations() const { return contents_->expectations; }

Result<std::vector<std::byte>> Capture::expected_image(std::string_view name, std::uint64_t bytes) const {
    return within_memory("read", contents_->container.file_name(), [&] { return contents_->expected_image(name, bytes); });
}

Result<Frame> Capture::frame(std::size_t index) const {
    return within_memory("read", contents_->container.file_name(), [&] { return contents_->decoded(index); });
}

Result<std::vector<std::byte>> Capture::Contents::expected_image(std::string_view name, std::uint64_t bytes) {
    const auto hash = parse_blob_hash(name);
    if (!hash)
        return fail(Fault::bad_input, "expect.image_name", "an expectation names the image '{image}', which is not a hash", name);
    const std::lock_guard lock(decoding);
    if (!images) {
        Result<BlobStore> opened = BlobStore::open(container, budget, SectionType::expect);
        if (!opened) return opened.error();
        images = *std::move(opened);
    }
    images->keep_only_used();  // those of the expectation before the last
    return images->find({*hash, bytes}).and_then([&](auto& found) { return std::vector<std::byte>(found.begin(), found.end()); });
}

Result<Frame> Capture::Contents::decoded(std::size_t index) {
    if (index >= frames.size()) {
        return fail(Fault::usage, "capture.no_frame", "there is no frame {frame}: the capture has {frames}, numbered from 0",
                    index, frames.size());
    }
    const std::size_t number = frames[index];
    const std::lock_guard lock(decoding);
    const auto found = flatbuffer(index);
    if (!found) return found.error();
    Result<Frame> decoded = decode_frame(*found, *blobs, budget);
    blobs->keep_only_used();
    if (!decoded) return container.located(number, decoded.error());
    Frame frame = upgrade(*std::move(decoded), container.sections()[number].version);
    if (const Result<void> checked = check_frame(frame); !checked) return container.located(number, checked.error());
    return frame;
}

}  // namespace strata
