#include "capture_format/container/blob_filter.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>

#include <zstd.h>

#include "capture_format/container/ray_records.h"

namespace strata {
namespace {

/// Smaller blobs are not worth the trials.
constexpr std::size_t smallest_filtered = 4096;
/// Of a blob, to compare filters by.
constexpr std::size_t trial_bytes = 32768;
/// A filter that saves less costs more time when reading than it is worth.
constexpr double least_saving = 0.1;
constexpr std::size_t corners = 3;  // of a triangle
constexpr BlobFilter table_filter{.stride = sizeof(double)};

// Groups at a time, so that what is read and what is written stay in the processor's first cache.
constexpr std::size_t groups_at_once = 256;

void rearrange(std::span<const std::byte> from, const BlobFilter& filter, std::span<std::byte> to) {
    const std::size_t stride = filter.stride, groups = from.size() / stride;
    std::vector<std::byte> differences;
    for (std::size_t first = 0; first < groups; first += groups_at_once) {
        const std::size_t count = std::min(groups_at_once, groups - first), begin = first * stride;
        std::span<const std::byte> chunk = from.subspan(begin, count * stride);
        if (filter.step > 0) {
            differences.resize(chunk.size());
            std::size_t i = 0;
            for (; i < chunk.size() && begin + i < filter.step; ++i) differences[i] = chunk[i];
            for (; i < chunk.size(); ++i)
                differences[i] = static_cast<std::byte>(std::to_integer<unsigned>(chunk[i]) -
                                                        std::to_integer<unsigned>(from[begin + i - filter.step]));
            chunk = differences;
        }
        for (std::size_t n = 0; n < stride; ++n) {
            std::byte* plane = to.data() + n * groups + first;
            for (std::size_t i = 0; i < count; ++i) plane[i] = chunk[i * stride + n];
        }
    }
    std::ranges::copy(from.subspan(groups * stride), to.subspan(groups * stride).begin());
}

/// Adds eight bytes to eight others, each modulo 256.
std::uint64_t add_bytes(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t high = 0x8080808080808080;
    return ((a & ~high) + (b & ~high)) ^ ((a ^ b) & high);
}

/// Adds to every byte from `begin` on the one `step` before it.
void add_up(std::span<std::byte> bytes, std::size_t begin, std::size_t step) {
    std::size_t i = std::max(begin, step);
    for (; step >= sizeof(std::uint64_t) && i + sizeof(std::uint64_t) <= bytes.size(); i += sizeof(std::uint64_t)) {
        std::uint64_t now = 0, before = 0;
        std::memcpy(&now, &bytes[i], sizeof now);
        std::memcpy(&before, &bytes[i - step], sizeof before);
        now = add_bytes(now, before);
        std::memcpy(&bytes[i], &now, sizeof now);
    }
    for (; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::byte>(std::to_integer<unsigned>(bytes[i]) + std::to_integer<unsigned>(bytes[i - step]));
}

void undo_rearrange(std::span<const std::byte> from, const BlobFilter& filter, std::span<std::byte> to) {
    const std::size_t stride = filter.stride, groups = from.size() / stride;
    for (std::size_t first = 0; first < groups; first += groups_at_once) {
        const std::size_t count = std::min(groups_at_once, groups - first), begin = first * stride;
        for (std::size_t n = 0; n < stride; ++n) {
            const std::byte* plane = from.data() + n * groups + first;
            for (std::size_t i = 0; i < count; ++i) to[begin + i * stride + n] = plane[i];
        }
        if (filter.step > 0) add_up(to.first(begin + count * stride), begin, filter.step);
    }
    std::ranges::copy(from.subspan(groups * stride), to.subspan(groups * stride).begin());
}

/// Compares filters by what a part of the bytes takes after them.
class Trial {
public:
    explicit Trial(std::span<const std::byte> bytes) : whole_(bytes.size()) {
        // From the middle: the first elements of a list are often unlike the others. Whole groups of any stride that is tried.
        const std::size_t count = std::min(bytes.size(), trial_bytes);
        part_ = bytes.subspan((bytes.size() - count) / 2, count);
    }

    /// Estimate for all bytes.
    double packed_bytes(const BlobFilter& filter) {
        std::vector<std::byte> tried(part_.size()), packed(ZSTD_compressBound(part_.size()));
        rearrange(part_, filter, tried);
        const std::size_t size = ZSTD_compressCCtx(context_.get(), packed.data(), packed.size(), tried.data(), tried.size(), 1);
        return double(size) * double(whole_) / double(part_.size());
    }

private:
    std::size_t whole_;
    std::span<const std::byte> part_;
    std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context_{ZSTD_createCCtx(), &ZSTD_freeCCtx};
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

FilteredBlob filtered(std::vector<std::byte> blob, std::size_t element_bytes) {
    if (element_bytes <= 1 || element_bytes > 4096 || blob.size() < smallest_filtered) return {{}, std::move(blob)};
    Trial of_own(blob);
    Best best{{}, of_own.packed_bytes({}) * (1 - least_saving)};
    best.try_all(of_own, BlobShape::own, element_bytes);
    const auto rays = element_bytes == position_bytes ? ray_records(blob) : std::nullopt;
    if (rays) {
        Trial of_rays(bytes_of(rays->records));
        best.try_all(of_rays, BlobShape::ray_records, sizeof(RayRecord));
        if (best.filter.shape == BlobShape::ray_records) return {best.filter, stored(*rays, best.filter)};
    }
    if (best.filter == BlobFilter{}) return {{}, std::move(blob)};
    std::vector<std::byte> rearranged(blob.size());
    rearrange(blob, best.filter, rearranged);
    return {best.filter, std::move(rearranged)};
}

bool undo_filter(std::span<const std::byte> filtered, const BlobFilter& filter, std::span<std::byte> blob) {
    if (filter.stride == 0 || filter.reserved != 0) return false;
    if (filter.shape == BlobShape::ray_records) return undo_stored(filtered, filter, blob);
    if (filter.shape != BlobShape::own || filtered.size() != blob.size()) return false;
    if (filter == BlobFilter{}) std::ranges::copy(filtered, blob.begin());
    else undo_rearrange(filtered, filter, blob);
    return true;
}

}  // namespace strata
