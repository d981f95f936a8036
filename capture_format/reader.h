// Opens a capture: verify, check every index, present as Frame. After check_frame() the rest of the program indexes freely.
// Who asks for frames includes capture_format/frame.h, too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/partial.h"
#include "capture_format/result.h"

namespace strata {

class Container;

/// What is in the file without decoding frames.
struct CaptureSummary {
    std::uint32_t container_version = 0, format_version = 0;
    std::uint64_t file_bytes = 0, blob_bytes_stored = 0, blob_bytes_raw = 0;
    std::size_t frames = 0, blobs = 0;
    bool cut_short = false;
    std::string notes;                  ///< free text of the notes section, as clean_text() leaves it
    std::vector<std::string> left_out;  ///< what was not read, and why: sections of a newer program, or damaged where partial
};

class Capture {
public:
    /// The memory budget bounds in bytes what is unpacked of the file at a time, the frame that is being read among it; frames
    /// that were returned are the caller's. 0: half of the machine's memory. What needs more fails with Fault::device_lacks.
    static Result<Capture> open(const std::filesystem::path&, Partial = Partial::refused, std::uint64_t memory_budget = 0);
    /// A capture in memory, copied; `name` stands for the path in sentences.
    static Result<Capture> open(std::span<const std::byte>, std::string name, Partial = Partial::refused,
                                std::uint64_t memory_budget = 0);
    Capture(Capture&&) noexcept;
    Capture& operator=(Capture&&) noexcept;
    ~Capture();

    std::size_t frame_count() const;
    /// Decodes and checks one frame. Cheapest in order: blobs shared with the frame asked for before are not decompressed again,
    /// and a frame is told by what changed since the ones before it, up to 63 of which are unpacked first when it is asked for
    /// out of order.
    /// Names are UTF-8 without control characters: clean_text().
    Result<Frame> frame(std::size_t index) const;
    /// 32 hex digits over the frames and their blobs: equal files have equal ids wherever they lie, and notes, thumbnail and
    /// expectations do not change it.
    const std::string& id() const;
    const CaptureSummary& summary() const;
    /// Small RGBA8 picture, empty when there is none.
    const Texture& thumbnail() const;
    /// The texts of ExpectationWriter and append_expectation(), oldest first.
    const std::vector<std::string>& expectations() const;
    /// Texels that were kept with the expectations: by the name ExpectationWriter::add_image() gave, and how many bytes.
    Result<std::vector<std::byte>> expected_image(std::string_view name, std::uint64_t bytes) const;

private:
    struct Contents;
    explicit Capture(std::unique_ptr<Contents>);
    static Result<Capture> read(Result<Container>, Partial, std::uint64_t memory_budget);
    std::unique_ptr<Contents> contents_;
};

/// Every index, count, enum and float of a frame; the sentence names the first that is wrong.
Result<void> check_frame(const Frame&);

}  // namespace strata
