// Adds what replays are expected to give to a finished capture. The work is done on a copy that takes the capture's place when
// it is whole: whoever is stopped on the way leaves the capture as it was. The capture's id stays the same.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "capture_format/result.h"

namespace strata {

class ExpectationWriter {
public:
    /// Waits while another writer, of this or another process, extends the capture: read what it expects after this. Fails for
    /// what is no finished capture.
    static Result<ExpectationWriter> extend(const std::filesystem::path& capture);
    /// Fails as extend() would for what is no finished capture, and locks nothing.
    static Result<void> check(const std::filesystem::path& capture);
    ExpectationWriter(ExpectationWriter&&) noexcept;
    ExpectationWriter& operator=(ExpectationWriter&&) noexcept;
    ~ExpectationWriter();

    /// Keeps an image's texels (any bytes, up to 1 GiB) with the text that follows. Equal ones are stored once. Returns what
    /// Capture::expected_image() finds them by.
    std::string add_image(std::span<const std::byte> texels);
    /// Text as the replayer writes it, up to 64 MiB.
    Result<void> add(std::string_view text);
    /// Puts the extended capture in the old one's place. Fails (usage) where it cannot, or where the old one is no longer there.
    Result<void> finish();

private:
    struct Extended;
    explicit ExpectationWriter(std::unique_ptr<Extended>);
    std::unique_ptr<Extended> extended_;
};

}  // namespace strata
