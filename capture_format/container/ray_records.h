// Positions that lie on few rays from the origin, as those of a deep image's samples do: x and y are the depth z times one of a
// thousand numbers, but as floats they look random and are most of the file.
//
//   rays   = columns:u32  rows:u32  x_per_z:f64{columns}  y_per_z:f64{rows}  record{}
//   record = column:u16  row:u16  z:f32             x = float(x_per_z[column] * z), in double; y likewise
//
// The two lists are stored as BlobFilter{.stride = 8} rearranges them, the records as the blob's filter does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace strata {

/// A position of three floats.
inline constexpr std::size_t position_bytes = 12;

struct RayRecord {
    std::uint16_t column = 0, row = 0;
    float z = 0;
};
static_assert(sizeof(RayRecord) == 8);

struct RayRecords {
    std::vector<double> x_per_z, y_per_z;  ///< ascending
    std::vector<RayRecord> records;
};

/// Nothing where the blob is not made of such positions, to the bit, or not of triangles that each lie at one depth.
std::optional<RayRecords> ray_records(std::span<const std::byte> positions);
/// False where a record names a column or a row that there is not. There are as many records as positions.
bool undo_ray_records(const RayRecords&, std::span<std::byte> positions);

}  // namespace strata
