#include "tests/fuzz/mutate_record.h"

#include <cstring>
#include <iterator>

namespace strata {

void mutate_record(std::vector<Record>& records, std::minstd_rand& random,
                   const std::function<void(std::vector<std::byte>&)>& change_bytes) {
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
        default:
            change_bytes(record.bytes);
    }
}

}  // namespace strata
