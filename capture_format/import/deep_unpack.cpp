#include "capture_format/import/deep_unpack.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include <libdeflate.h>

namespace strata {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's order is the machine's");

/// Running sums of eight bytes, each modulo 256, on top of `carry`: sums of even and odd bytes apart, in lanes of 16 bits that
/// cannot overflow (9 * 255).
std::uint64_t running_sums(std::uint64_t bytes, std::uint64_t& carry) {
    constexpr std::uint64_t low = 0x00ff00ff00ff00ff, each = 0x0001000100010001;
    const std::uint64_t even = (bytes & low) * each, odd = (bytes >> 8 & low) * each;
    const std::uint64_t at_even = even + (odd << 16) + carry * each, at_odd = even + odd + carry * each;
    carry = at_odd >> 48 & 0xff;
    return (at_even & low) | (at_odd & low) << 8;
}

}  // namespace

bool unpack_rle(std::span<const std::byte> packed, std::span<std::byte> unpacked) {
    while (!packed.empty()) {
        const int code = static_cast<signed char>(packed[0]);
        const bool literal = code < 0;
        const std::size_t count = static_cast<std::size_t>(literal ? -code : code + 1), taken = literal ? count + 1 : 2;
        if (packed.size() < taken || unpacked.size() < count) return false;
        if (literal) std::ranges::copy(packed.subspan(1, count), unpacked.begin());
        else std::ranges::fill(unpacked.first(count), packed[1]);
        packed = packed.subspan(taken);
        unpacked = unpacked.subspan(count);
    }
    return unpacked.empty();
}

bool unpack_deflate(libdeflate_decompressor& inflater, std::span<const std::byte> packed, std::span<std::byte> unpacked) {
    return libdeflate_zlib_decompress(&inflater, packed.data(), packed.size(), unpacked.data(), unpacked.size(), nullptr) ==
           LIBDEFLATE_SUCCESS;
}

void undo_deltas(std::span<std::byte> deltas, std::span<std::byte> bytes) {
    // OpenEXR adds 128 to each difference but the first: after an odd number of them that is 128 again, after an even 0.
    constexpr std::uint64_t odd_bias = 0x8000800080008000;
    std::uint64_t carry = 0;
    std::size_t i = 0;
    for (; i + 8 <= deltas.size(); i += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, &deltas[i], 8);
        eight = running_sums(eight, carry) ^ odd_bias;
        std::memcpy(&deltas[i], &eight, 8);
    }
    for (; i < deltas.size(); ++i) {
        carry = (carry + std::to_integer<std::uint64_t>(deltas[i])) & 0xff;
        deltas[i] = static_cast<std::byte>(carry ^ (i % 2 == 0 ? 0 : 0x80));
    }
    const std::size_t odd = bytes.size() / 2, even = bytes.size() - odd;
    const std::byte *first = deltas.data(), *second = deltas.data() + even;
    std::byte* to = bytes.data();
    for (std::size_t pair = 0; pair < odd; ++pair) {
        to[2 * pair] = first[pair];
        to[2 * pair + 1] = second[pair];
    }
    if (even > odd) to[2 * odd] = first[odd];
}

}  // namespace strata
