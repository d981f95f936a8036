#include "capture_format/container/blob_filter.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>

#include "capture_format/container/compression.h"
#include "capture_format/container/ray_records.h"

namespace strata {
namespace {

/// Smaller blobs are not worth the trials.
constexpr std::size_t smallest_filtered = 4096;
/// Of a blob, to compare filters by.
constexpr std::size_t trial_bytes = 32768;
/// A filter that saves less costs more time when reading than it saves in bytes.
constexpr double least_saving = 0.25;
constexpr std::size_t corners = 3;  // of a triangle
constexpr std::size_t largest_element = 4096;
constexpr BlobFilter table_filter{.stride = sizeof(double)};

// Groups at a time, so that what is read and what is written stay in the processor's first cache. A constant, and words instead
// of bytes, so that the loops below become vector code.
constexpr std::size_t groups_at_once = 256;
constexpr std::size_t word_bytes = 4;
using Words = std::array<std::uint32_t, groups_at_once>;
using Planes = std::array<std::array<std::uint8_t, groups_at_once>, word_bytes>;

void split(const Words& words, Planes& planes) {
    for (std::size_t n = 0; n < word_bytes; ++n)
        for (std::size_t i = 0; i < groups_at_once; ++i) planes[n][i] = static_cast<std::uint8_t>(words[i] >> (8 * n));
}

void join(const Planes& planes, Words& words) {
    for (std::size_t i = 0; i < groups_at_once; ++i)
        words[i] = std::uint32_t{planes[0][i]} | std::uint32_t{planes[1][i]} << 8 | std::uint32_t{planes[2][i]} << 16 |
                   std::uint32_t{planes[3][i]} << 24;
}

/// Four or eight bytes at once, each modulo 256.
template <typename Word>
Word add_bytes(Word a, Word b) {
    constexpr Word high = static_cast<Word>(0x8080808080808080);
    return ((a & ~high) + (b & ~high)) ^ ((a ^ b) & high);
}
std::uint32_t subtract_bytes(std::uint32_t a, std::uint32_t b) {
    constexpr std::uint32_t high = 0x80808080;
    return ((a | high) - (b & ~high)) ^ ((a ^ ~b) & high);
}

template <typename Word>
Word word_at(std::span<const std::byte> bytes, std::size_t i) {
    Word word;
    std::memcpy(&word, bytes.data() + i, sizeof word);
    return word;
}

void rearrange(std::span<const std::byte> from, const BlobFilter& filter, std::span<std::byte> to) {
    const std::size_t stride = filter.stride, groups = stride == 0 ? 0 : from.size() / stride;
    Words words{};
    Planes planes{};
    for (std::size_t first = 0; first < groups; first += groups_at_once) {
        const std::size_t count = std::min(groups_at_once, groups - first);
        for (std::size_t n = 0; n < stride; n += word_bytes) {
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t place = (first + i) * stride + n;
                words[i] = word_at<std::uint32_t>(from, place);
                if (filter.step > 0 && place >= filter.step)
                    words[i] = subtract_bytes(words[i], word_at<std::uint32_t>(from, place - filter.step));
            }
            split(words, planes);
            for (std::size_t k = 0; k < word_bytes; ++k) std::memcpy(&to[(n + k) * groups + first], planes[k].data(), count);
        }
    }
    std::ranges::copy(from.subspan(groups * stride), to.subspan(groups * stride).begin());
}

/// Adds to every word from `begin` on the bytes `step` before it.
template <typename Word>
void add_up(std::span<std::byte> bytes, std::size_t begin, std::size_t step) {
    std::size_t i = std::max(begin, step);
    for (; i + sizeof(Word) <= bytes.size(); i += sizeof(Word)) {
        const Word sum = add_bytes(word_at<Word>(bytes, i), word_at<Word>(bytes, i - step));
        std::memcpy(&bytes[i], &sum, sizeof sum);
    }
    if constexpr (sizeof(Word) > word_bytes)
        if (i < bytes.size()) add_up<std::uint32_t>(bytes, i, step);
}

void undo_rearrange(std::span<const std::byte> from, const BlobFilter& filter, std::span<std::byte> to) {
    const std::size_t stride = filter.stride, groups = stride == 0 ? 0 : from.size() / stride;
    Words words{};
    Planes planes{};
    for (std::size_t first = 0; first < groups; first += groups_at_once) {
        const std::size_t count = std::min(groups_at_once, groups - first), begin = first * stride;
        for (std::size_t n = 0; n < stride; n += word_bytes) {
            for (std::size_t k = 0; k < word_bytes; ++k) std::memcpy(planes[k].data(), &from[(n + k) * groups + first], count);
            join(planes, words);
            for (std::size_t i = 0; i < count; ++i) std::memcpy(&to[begin + i * stride + n], &words[i], word_bytes);
        }
        const std::span<std::byte> done = to.first(begin + count * stride);
        if (filter.step >= sizeof(std::uint64_t)) add_up<std::uint64_t>(done, begin, filter.step);
        else if (filter.step > 0) add_up<std::uint32_t>(done, begin, filter.step);
    }
    std::ranges::copy(from.subspan(groups * stride), to.subspan(groups * stride).begin());
}

bool is_known(const BlobFilter& filter) {
    return filter.reserved == 0 && filter.step % word_bytes == 0 && filter.stride % word_bytes == 0 &&
           filter.stride <= corners * largest_element && (filter.stride > 0 || filter.step == 0);
}

/// Compares filters by what a part of the bytes takes after them.
class Trial {
public:
    explicit Trial(std::span<const std::byte> bytes) : whole_(bytes.size()) {
        // From the middle: the first elements of a list are often unlike the others.
        const std::size_t count = std::min(bytes.size(), trial_bytes);
        part_ = bytes.subspan((bytes.size() - count) / 2, count);
    }

    /// Estimate for all bytes.
    double packed_bytes(const BlobFilter& filter) {
        std::vector<std::byte> tried(part_.size()), packed;
        rearrange(part_, filter, tried);
        compression_.append(packed, tried, 1);
        return double(packed.size()) * double(whole_) / double(part_.size());
    }

private:
    std::size_t whole_;
    std::span<const std::byte> part_;
    Compression compression_;
};

/// The best filter found so far, and what it is expected to leave.
struct Best {
    BlobFilter filter;
    double bytes = 0;

    /// Tries the elements' own bytes, their differences, and the differences in triangles' corners.
    void try_all(Trial& trial, BlobShape shape, std::size_t element_bytes) {
        const auto element = static_cast<std::uint16_t>(element_bytes), triangle = static_cast<std::uint16_t>(corners * element);
        for (const auto& [step, stride] : {std::pair{std::uint16_t{0}, element}, {element, element}, {element, triangle}}) {
            const BlobFilter tried{.shape = shape, .step = step, .stride = stride};
            if (const double packed = trial.packed_bytes(tried); packed < bytes) *this = {tried, packed};
        }
    }
};

std::span<const std::byte> bytes_of(const std::vector<RayRecord>& records) { return std::as_bytes(std::span(records)); }

void append_filtered(std::vector<std::byte>& to, std::span<const std::byte> bytes, const BlobFilter& filter) {
    to.resize(to.size() + bytes.size());
    rearrange(bytes, filter, std::span(to).last(bytes.size()));
}

/// As ray_records.h has them.
std::vector<std::byte> stored(const RayRecords& rays, const BlobFilter& filter) {
    const std::uint32_t counts[] = {static_cast<std::uint32_t>(rays.x_per_z.size()),
                                    static_cast<std::uint32_t>(rays.y_per_z.size())};
    std::vector<std::byte> bytes;
    bytes.reserve(sizeof counts + (rays.x_per_z.size() + rays.y_per_z.size()) * sizeof(double) +
                  rays.records.size() * sizeof(RayRecord));
    append_filtered(bytes, std::as_bytes(std::span(counts)), {});
    append_filtered(bytes, std::as_bytes(std::span(rays.x_per_z)), table_filter);
    append_filtered(bytes, std::as_bytes(std::span(rays.y_per_z)), table_filter);
    append_filtered(bytes, bytes_of(rays.records), filter);
    return bytes;
}

bool undo_stored(std::span<const std::byte> bytes, const BlobFilter& filter, std::span<std::byte> positions) {
    std::uint32_t counts[2] = {};
    if (positions.size() % position_bytes != 0 || bytes.size() < sizeof counts) return false;
    std::memcpy(counts, bytes.data(), sizeof counts);
    const std::uint64_t records = positions.size() / position_bytes, numbers = std::uint64_t{counts[0]} + counts[1];
    if (bytes.size() != sizeof counts + numbers * sizeof(double) + records * sizeof(RayRecord)) return false;
    RayRecords rays{.x_per_z = std::vector<double>(counts[0]),
                    .y_per_z = std::vector<double>(counts[1]),
                    .records = std::vector<RayRecord>(records)};
    bytes = bytes.subspan(sizeof counts);
    const auto take = [&bytes](auto& list, const BlobFilter& by) {
        const auto to = std::as_writable_bytes(std::span(list));
        undo_rearrange(bytes.first(to.size()), by, to);
        bytes = bytes.subspan(to.size());
    };
    take(rays.x_per_z, table_filter);
    take(rays.y_per_z, table_filter);
    take(rays.records, filter);
    return undo_ray_records(rays, positions);
}

}  // namespace

std::vector<std::byte> rearranged(std::span<const std::byte> bytes, const BlobFilter& filter) {
    std::vector<std::byte> result(bytes.size());
    rearrange(bytes, filter, result);
    return result;
}

std::optional<FilteredBlob> filtered(std::span<const std::byte> blob, std::size_t element_bytes) {
    if (element_bytes % word_bytes != 0 || element_bytes > largest_element || blob.size() < smallest_filtered)
        return std::nullopt;
    Trial of_own(blob);
    Best best{{}, of_own.packed_bytes({}) * (1 - least_saving)};
    best.try_all(of_own, BlobShape::own, element_bytes);
    const auto rays = element_bytes == position_bytes ? ray_records(blob) : std::nullopt;
    if (rays) {
        Trial of_rays(bytes_of(rays->records));
        best.try_all(of_rays, BlobShape::ray_records, sizeof(RayRecord));
    }
    if (best.filter == BlobFilter{}) return std::nullopt;
    if (best.filter.shape == BlobShape::own) return FilteredBlob{best.filter, rearranged(blob, best.filter)};
    std::vector<std::byte> bytes = stored(*rays, best.filter);  // with its tables, which the trial did not see
    if (bytes.size() >= blob.size()) return std::nullopt;
    return FilteredBlob{best.filter, std::move(bytes)};
}

bool undo_filter(std::span<const std::byte> filtered, const BlobFilter& filter, std::span<std::byte> blob) {
    if (!is_known(filter)) return false;
    if (filter.shape == BlobShape::ray_records) return undo_stored(filtered, filter, blob);
    if (filter.shape != BlobShape::own || filtered.size() != blob.size()) return false;
    undo_rearrange(filtered, filter, blob);
    return true;
}

}  // namespace strata
