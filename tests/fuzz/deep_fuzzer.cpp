// The deep EXR importer under libFuzzer. Its files have no checksums: mutations reach everything but what is deflated.
#include "capture_format/frame/frame.h"
#include "capture_format/import/deep.h"
#include "capture_format/reader.h"
#include "tests/fuzz/walk_frame.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace strata;
    const auto image = import_deep(std::as_bytes(std::span(data, size)), "fuzz", {.most_samples = 1u << 16});
    if (!image) return 0;
    if (!check_frame(image->frame)) std::abort();
    volatile const double sum = walk(image->frame);
    static_cast<void>(sum);
    return 0;
}
