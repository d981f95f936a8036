#include "replay/cli/expected_results.h"

namespace strata {
namespace {

/// Fails where the frame has no counterpart of its size.
Result<void> check_frame_of(const Capture& other, const std::filesystem::path& path, Session& session, std::size_t frame) {
    if (frame >= other.frame_count())
        return fail(Fault::usage, "expect.no_frame",
                    "{file} has no frame {frame}: the capture has {frames}, numbered from 0; choose others with --frames",
                    path.string(), frame, other.frame_count());
    const auto own = session.frame(frame);
    if (!own) return own.error();
    const auto before = other.frame(frame);
    if (!before) return before.error();
    const View &a = before->view, &b = own->view;
    if (a.width == b.width && a.height == b.height) return {};
    return fail(
        Fault::usage, "expect.other_size",
        "frame {frame} is {width} x {height} pixels, but {other_width} x {other_height} in {file}; record both at one size",
        frame, b.width, b.height, a.width, a.height, path.string());
}

}  // namespace

Result<ExpectedResults> expected_results(Session& session, const OpenOptions& options, const std::filesystem::path& other,
                                         std::span<const std::size_t> frames) {
    ExpectedResults expected;
    if (!other.empty()) {
        auto opened =
            open_capture(other, options.allow_partial ? Partial::allowed : Partial::refused, options.device.memory_budget);
        if (!opened) return opened.error();
        expected.other = *std::move(opened);
        for (const std::size_t frame : frames)
            if (const auto fits = check_frame_of(*expected.other, other, session, frame); !fits) return fits.error();
    }
    auto known = expectations_of(expected.capture(session));
    if (!known) return known.error();
    expected.expectations = *std::move(known);
    return expected;
}

}  // namespace strata
