// Writes the first inputs of the reader's fuzzer into a folder. After the format has changed: run it, fuzz for a while, and put
// what -merge=1 keeps into corpus/reader.
#include "capture_format/container/whole_file.h"
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/fuzz/frame_records.h"

namespace strata {
namespace {

bool write_seed(const std::filesystem::path& path, std::span<const Record> records) {
    std::vector<std::byte> input = text_of(records);
    input.insert(input.begin(), std::byte{0});
    return bool(write_whole_file(path, input));
}

/// Frames in which something moves and something is added: each but the first builds on those before.
std::vector<Record> moving() {
    Frame frame = triangle_frame();
    std::vector<Record> records = records_of(frame, RecordKind::frame);
    for (int i = 0; i < 3; ++i) {
        frame.draws[0].to_world[3].x += .5;
        if (i == 1) frame.fog.density = 1;
        if (i == 2) frame.draws.push_back(frame.draws[0]);
        records.push_back(records_of(frame, RecordKind::frame).back());
    }
    return records;
}

std::vector<Record> texts() {
    std::vector<Record> records = records_of(triangle_frame(), RecordKind::old_frame);
    for (const std::uint8_t type : std::initializer_list<std::uint8_t>{5, 4, 1, 77})
        records.push_back({RecordKind::section, type, 1, 0, std::vector<std::byte>(24, std::byte{'a'})});
    return records;
}

}  // namespace
}  // namespace strata

int main(int count, char** arguments) {
    using namespace strata;
    if (count != 2) return 2;
    const std::filesystem::path folder = arguments[1];
    const bool written = write_seed(folder / "rich", records_of(rich_frame(), RecordKind::frame)) &&
                         write_seed(folder / "rich_old", records_of(rich_frame(), RecordKind::old_frame)) &&
                         write_seed(folder / "moving", moving()) && write_seed(folder / "texts", texts());
    return written ? 0 : 3;
}
