// The capture reader under libFuzzer. An input is either a file as it is or, when its first byte is even, a list of records that
// is sealed first: mutations of flatbuffers, blobs and section headers then pass the checksums as a forger's would.
#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "tests/fuzz/mutate_record.h"
#include "tests/fuzz/walk_frame.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace strata {
namespace {

/// A file in memory; opening its path again empties it.
const std::filesystem::path& scratch(int which) {
    static const std::filesystem::path paths[] = {fmt::format("/proc/self/fd/{}", ::memfd_create("sealed", 0)),
                                                  fmt::format("/proc/self/fd/{}", ::memfd_create("again", 0))};
    return paths[which];
}

void read_all(const Result<Capture>& capture) {
    if (!capture) return;
    for (std::size_t i = 0; i < capture->frame_count(); ++i) {
        const auto frame = capture->frame(i);
        if (!frame) continue;
        volatile const double sum = walk(*frame);
        static_cast<void>(sum);
        // One in 16, chosen by what it is: writing takes longer than everything else.
        if (capture->id().back() == '0') expect_survives_writing(*frame, scratch(1));
    }
}

void run(std::span<const std::byte> input) {
    if (input.empty()) return;
    const bool sealed = (input[0] & std::byte{1}) == std::byte{0};
    input = input.subspan(1);
    if (!sealed) return read_all(Capture::open(input, "fuzz", Partial::allowed));
    if (seal(parse_records(input), scratch(0))) read_all(Capture::open(scratch(0), Partial::allowed));
}

}  // namespace
}  // namespace strata

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    strata::run(std::as_bytes(std::span(data, size)));
    return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    std::minstd_rand random(seed);
    if (size < 1 || (data[0] & 1) != 0 || random() % 16 == 0) return LLVMFuzzerMutate(data, size, most);
    std::vector<strata::Record> records = strata::parse_records(std::as_bytes(std::span(data + 1, size - 1)));
    if (records.empty()) return LLVMFuzzerMutate(data, size, most);
    strata::mutate_record(records, random, [&](std::vector<std::byte>& bytes) {
        const std::size_t size = bytes.size();
        bytes.resize(std::min(size + 64, std::max(size, most)));
        bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
    });
    const std::vector<std::byte> text = strata::text_of(records);
    if (text.size() + 1 > most) return LLVMFuzzerMutate(data, size, most);
    std::memcpy(data + 1, text.data(), text.size());
    return text.size() + 1;
}
