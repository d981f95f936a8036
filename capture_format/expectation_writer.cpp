// Texts are expect sections of version 1, their images expect sections of version 2 before them, in the grammar of blobs.
#include "capture_format/expectation_writer.h"

#include "capture_format/container/blob_store.h"
#include "capture_format/container/container.h"
#include "capture_format/container/picture.h"
#include "capture_format/container/whole_file.h"
#include "capture_format/recorder.h"

namespace strata {

struct ExpectationWriter::Extended {
    WholeFile file;
    ContainerWriter writer;
    BlobCollector images = {};
};

Result<ExpectationWriter> ExpectationWriter::extend(const std::filesystem::path& capture) {
    // Before anything is copied: what is no capture is refused with its own sentence.
    if (const auto old = Container::open(capture); !old) return old.error();
    auto file = WholeFile::begin(capture);
    if (!file) return file.error();
    std::error_code problem;
    std::filesystem::copy_file(capture, file->temporary(), std::filesystem::copy_options::overwrite_existing, problem);
    if (problem) return fail(Fault::usage, "cannot copy {}: {}", capture.string(), problem.message());
    return ContainerWriter::extend(file->temporary()).and_then([&](auto& writer) {
        return ExpectationWriter(std::make_unique<Extended>(Extended{*std::move(file), std::move(writer)}));
    });
}

ExpectationWriter::ExpectationWriter(std::unique_ptr<Extended> extended) : extended_(std::move(extended)) {}
ExpectationWriter::ExpectationWriter(ExpectationWriter&&) noexcept = default;
ExpectationWriter& ExpectationWriter::operator=(ExpectationWriter&&) noexcept = default;
ExpectationWriter::~ExpectationWriter() = default;

std::string ExpectationWriter::add_image(std::span<const std::byte> texels) { return text(extended_->images.put(texels).hash); }

Result<void> ExpectationWriter::add(std::string_view text) {
    if (text.size() > longest_expectation) {
        return fail(Fault::usage, "an expectation of {} bytes is too long; {} are the most", text.size(), longest_expectation);
    }
    const auto packed = extended_->images.pack();
    if (!packed) return packed.error();
    for (const PackedBlobs& images : *packed) {
        const Payload payload = {SectionType::expect, expect_images_version, images.stored, images.raw_bytes};
        if (const auto added = extended_->writer.add(payload); !added) return added;
    }
    return extended_->writer.add({SectionType::expect, expect_version, std::as_bytes(std::span(text)), text.size()});
}

Result<void> ExpectationWriter::finish() {
    if (const auto finished = extended_->writer.finish(); !finished) return finished;
    return extended_->file.commit();
}

Result<void> append_expectation(const std::filesystem::path& path, std::string_view expectation) {
    auto writer = ExpectationWriter::extend(path);
    if (!writer) return writer.error();
    if (const auto added = writer->add(expectation); !added) return added;
    return writer->finish();
}

}  // namespace strata
