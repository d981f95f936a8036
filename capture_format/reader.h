// Opens a capture: verify, check every index, present as Frame. After check_frame() the rest of the program indexes freely.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/frame.h"
#include "capture_format/result.h"

namespace strata {

/// Whether a file that was cut short may be read up to the cut.
enum class Partial { refused, allowed };

/// What is in the file without decoding frames.
struct CaptureSummary {
    std::uint32_t container_version = 0, format_version = 0;
    std::uint64_t file_bytes = 0, blob_bytes_stored = 0, blob_bytes_raw = 0;
    std::size_t frames = 0, blobs = 0;
    bool cut_short = false;
    std::string notes;  ///< free text of the notes section
};

class Capture {
public:
    static Result<Capture> open(const std::filesystem::path&, Partial = Partial::refused);
    Capture(Capture&&) noexcept;
    Capture& operator=(Capture&&) noexcept;
    ~Capture();

    std::size_t frame_count() const;
    /// Decodes and checks one frame. Blobs that the frame shares with the one asked for before are not decompressed again.
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
    std::unique_ptr<Contents> contents_;
};

/// Every index, count, enum and float of a frame; the sentence names the first that is wrong.
Result<void> check_frame(const Frame&);

}  // namespace strata
