// Blobs are rearranged, without loss, before they are compressed: bytes that mean the same (all exponents, all low bytes) come
// to lie side by side. Vertices, indices and texels take a half to a tenth of the room then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace strata {

/// Which bytes are compressed instead of a blob's own. Stored as it is.
enum class BlobShape : std::uint16_t {
    own,          ///< the blob's bytes
    ray_records,  ///< ray_records.h
};

/// Bytes become differences (modulo 256) to the byte `step` before them, then the n-th bytes of all groups of `stride` follow
/// each other, for each n. What remains of the last group follows as it is. Both are multiples of 4; a step of 0 makes no
/// differences, a stride of 0 leaves the bytes in their order and has no step.
struct BlobFilter {
    BlobShape shape = BlobShape::own;
    std::uint16_t step = 0, stride = 0;
    std::uint16_t reserved = 0;  ///< 0
    friend bool operator==(const BlobFilter&, const BlobFilter&) = default;
};

struct FilteredBlob {
    BlobFilter filter;
    std::vector<std::byte> bytes;
};

/// By the filter after which a part of the blob compresses best; nothing where no filter saves enough, and where elements are not
/// made of words of 4 bytes. `element_bytes`: of a vertex attribute, an index, a texel, a particle.
std::optional<FilteredBlob> filtered(std::span<const std::byte> blob, std::size_t element_bytes);

/// The bytes by a known filter of the shape `own`.
std::vector<std::byte> rearranged(std::span<const std::byte>, const BlobFilter&);

/// Fills the blob. False where it could not have been filtered to these bytes, or where the filter is not known.
bool undo_filter(std::span<const std::byte> filtered, const BlobFilter&, std::span<std::byte> blob);

}  // namespace strata
