// The capture reader under libFuzzer. An input is either a file as it is or, when its first byte is even, a list of records that
// is sealed first: mutations of flatbuffers, blobs and section headers then pass the checksums as a forger's would.
#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "capture_format/reader.h"
#include "tests/fuzz/sealed_capture.h"
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

/// Changes one record of a sealed input and leaves the others' borders alone.
void mutate_record(std::vector<Record>& records, std::size_t most, std::minstd_rand& random) {
    Record& record = records[random() % records.size()];
    switch (random() % 16) {
        case 0:
            record.kind = static_cast<RecordKind>(random() % static_cast<std::uint32_t>(RecordKind::count_));
            return;
        case 1:
            record.type = static_cast<std::uint8_t>(random() % 64);
            record.version = static_cast<std::uint8_t>(random() % 4);
            return;
        case 2:
            record.claim = static_cast<std::uint8_t>(random());
            return;
        case 3:
            records.push_back(Record(records[random() % records.size()]));
            return;
        case 4:
            if (records.size() > 1) records.erase(records.begin() + static_cast<std::ptrdiff_t>(random() % records.size()));
            return;
        case 5:
        case 6:
        case 7: {  // an offset, an index, an enum or a float of a flatbuffer
            constexpr std::uint32_t telling[] = {0,          1,          2,          0x7fffffff, 0x80000000,
                                                 0xffffffff, 0x7fc00000, 0x7f800000, 0x7f7fffff, 0x00000004};
            const std::uint32_t word = random() % 3 ? telling[random() % std::size(telling)] : random() % 64;
            if (record.bytes.size() >= 4) std::memcpy(&record.bytes[random() % (record.bytes.size() / 4) * 4], &word, 4);
            return;
        }
        default: {
            const std::size_t size = record.bytes.size();
            record.bytes.resize(std::min(size + 64, std::max(size, most)));
            record.bytes.resize(
                LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(record.bytes.data()), size, record.bytes.size()));
        }
    }
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
    strata::mutate_record(records, most, random);
    const std::vector<std::byte> text = strata::text_of(records);
    if (text.size() + 1 > most) return LLVMFuzzerMutate(data, size, most);
    std::memcpy(data + 1, text.data(), text.size());
    return text.size() + 1;
}
