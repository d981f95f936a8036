// Texts are expect sections of version 1, their images expect sections of version 2 before them, in the grammar of blobs.
#include "capture_format/expectation_writer.h"

#include <optional>

#include "capture_format/container/blob_store.h"
#include "capture_format/container/container.h"
#include "capture_format/container/picture.h"
#include "capture_format/container/whole_file.h"
#include "capture_format/out_of_memory.h"

namespace strata {

/// The copy and its writer are there from the first add() on: whoever adds nothing copies nothing.
struct ExpectationWriter::Extended {
    std::filesystem::path capture;
    FileLock lock;
    std::optional<WholeFile> file = {};
    std::optional<ContainerWriter> writer = {};
    BlobCollector images = {};

    Result<void> begin();
};

Result<void> ExpectationWriter::Extended::begin() {
    auto begun = WholeFile::begin(capture);
    if (!begun) return begun.error();
    std::error_code problem;
    begun->opened_by([&](const std::filesystem::path& path) {
        return std::filesystem::copy_file(capture, path, std::filesystem::copy_options::overwrite_existing, problem);
    });
    if (problem)
        return fail(Fault::usage, "file.cannot_copy", "cannot copy {file}: {reason}", capture.string(), problem.message());
    auto extended = ContainerWriter::extend(begun->temporary());
    if (!extended) return extended.error();
    file = *std::move(begun);
    writer = *std::move(extended);
    return {};
}

Result<void> ExpectationWriter::check(const std::filesystem::path& capture) {
    const auto old = Container::open(capture);
    if (!old) return old.error();
    if (!old->damage()) return {};
    return advised(*old->damage(), "expectations are appended to the end of a complete capture: record it again");
}

Result<ExpectationWriter> ExpectationWriter::extend(const std::filesystem::path& capture) {
    // Before anything is locked: what is no capture is refused with its own sentence.
    if (const auto whole = check(capture); !whole) return whole.error();
    auto lock = FileLock::take(capture);
    if (!lock) return lock.error();
    return ExpectationWriter(std::make_unique<Extended>(Extended{capture, *std::move(lock)}));
}

ExpectationWriter::ExpectationWriter(std::unique_ptr<Extended> extended) : extended_(std::move(extended)) {}
ExpectationWriter::ExpectationWriter(ExpectationWriter&&) noexcept = default;
ExpectationWriter& ExpectationWriter::operator=(ExpectationWriter&&) noexcept = default;
ExpectationWriter::~ExpectationWriter() = default;

std::string ExpectationWriter::add_image(std::span<const std::byte> texels) { return text(extended_->images.put(texels).hash); }

Result<void> ExpectationWriter::add(std::string_view text) {
    if (text.size() > longest_expectation) {
        return fail(Fault::usage, "expect.too_long", "an expectation of {bytes} bytes is too long; the limit is {most}",
                    text.size(), longest_expectation);
    }
    if (!extended_->writer)
        if (const auto begun = extended_->begin(); !begun) return begun;
    const auto packed = extended_->images.pack();
    if (!packed) return packed.error();
    for (const PackedBlobs& images : *packed) {
        const Payload payload = {SectionType::expect, expect_images_version, images.stored, images.raw_bytes};
        if (const auto added = extended_->writer->add(payload); !added) return added;
    }
    return extended_->writer->add({SectionType::expect, expect_version, std::as_bytes(std::span(text)), text.size()});
}

Result<void> ExpectationWriter::finish() {
    if (!extended_->writer) return {};
    if (const auto finished = extended_->writer->finish(); !finished) return finished;
    if (!extended_->lock.is_current()) {
        return fail(Fault::usage, "expect.capture_replaced",
                    "{file} was replaced by another program meanwhile and stays as it is; run this again",
                    extended_->capture.string());
    }
    return extended_->file->commit();
}

Result<void> append_expectation(const std::filesystem::path& path, std::string_view expectation) {
    return within_memory("write", path.native(), [&]() -> Result<void> {
        auto writer = ExpectationWriter::extend(path);
        if (!writer) return writer.error();
        if (const auto added = writer->add(expectation); !added) return added;
        return writer->finish();
    });
}

}  // namespace strata
