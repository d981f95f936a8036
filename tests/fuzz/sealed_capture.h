// A capture as a fuzzer's input: a list of records that is packed with right checksums, compression and hashes, so that
// mutations reach what lies behind them. The grammar is in sealed_capture.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace strata {

enum class RecordKind : std::uint8_t {
    blob,       ///< bulk bytes; later frames name the nth blob by a word of blob_mark and a word n instead of its hash
    frame,      ///< a flatbuffer, stored as the newest version does
    old_frame,  ///< a flatbuffer, stored as version 1 did
    section,    ///< a payload as it is
    count_,
};

struct Record {
    RecordKind kind = RecordKind::blob;
    std::uint8_t type = 0, version = 0;  ///< of a section. Of a frame: what is overwritten in its payload, and with which bits
    std::uint8_t claim = 0;              ///< a section's raw bytes are its own, or 2^claim of them
    std::vector<std::byte> bytes;
};

/// Stands where a flatbuffer has the first word of a blob's hash.
inline constexpr std::uint64_t blob_mark = 0x2362'6f6c'6223'2323;

/// Never fails: what is cut short is as long as it can be, unknown kinds are taken modulo.
std::vector<Record> parse_records(std::span<const std::byte>);
std::vector<std::byte> text_of(std::span<const Record>);

/// Writes the capture; false when even its writer refuses it.
bool seal(std::span<const Record>, const std::filesystem::path&);

}  // namespace strata
