// One column of voxels in integers, as exact as the device's: encoding, splat, overflow, integration; and how the integral is
// read (docs/algorithms/transparency.md 6.3 to 6.7).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "passes/transparency/voxel/voxel.shared.h"
#include "passes/transparency/voxel/voxel_params.h"

namespace strata::transparency {

/// How optical depth is stored: a code of 0 to M for 0 to ln M, added up in the fields of 32-bit words, nearest slice lowest.
struct ColumnFormat {
    std::uint32_t slices = 128;
    std::uint32_t splat = splat_overflow_minimum;
    std::uint32_t field_bits = 8;
    std::uint32_t full_code = 255;  ///< M: t = 1 / M, as good as nothing

    std::uint32_t slices_per_word() const { return 32 / field_bits; }
    std::uint32_t words() const { return (slices + slices_per_word() - 1) / slices_per_word(); }
    double codes_per_depth() const;
    /// Not rounded; at most M.
    double codes(double optical_depth) const;
    /// Of an integral in codes: from M on, nothing.
    double transmittance(double codes) const;
};
/// 8, 10 and 16 bits fill a field up to 255, 1023 and 65535. 32 bits are a slice's whole word, where M = 2^20 - 1 leaves room for
/// 4096 full additions and is exact in a float.
ColumnFormat column_format(const VoxelParams&);

/// Which slices a place belongs to: 1 - share to `slice` and share to the one behind.
struct SlicePlace {
    std::uint32_t slice = 0;
    double share = 0;
};
/// Point: the slice that contains s. Linear: by the distance to slices' centers; half a slice from the volume's ends all to one.
SlicePlace slice_place(double s, std::uint32_t slices, std::uint32_t splatting);

/// Integers for two neighboring slices. They add up to the code that is not split: rounding both would lose more.
struct SplitCode {
    std::uint32_t slice = 0, nearer = 0, farther = 0;
};
/// rounding: .5 to nearest, or a random number of [0, 1) that makes the code right on average.
SplitCode split_code(const ColumnFormat&, SlicePlace, double codes, double rounding);

class Column {
public:
    explicit Column(ColumnFormat format) : format_(format), words_(format.words(), 0) {}

    const ColumnFormat& format() const { return format_; }
    void add(std::uint32_t slice, std::uint32_t code);
    void add(SplitCode);

    /// Of a slice as it is stored, before integration.
    std::uint32_t field(std::uint32_t slice) const;
    /// The nearest slice known to have overflowed; no_overflow.
    std::uint32_t overflow() const { return overflow_; }
    /// Inclusive sums up to each slice, at most M; M from the overflow on.
    std::vector<std::uint32_t> integral() const;

private:
    ColumnFormat format_;
    std::vector<std::uint32_t> words_;
    std::uint32_t overflow_ = no_overflow;
};

/// How far in front of itself a fragment reads the integral, in slices: the least at which it does not hide itself, with point
/// splats and samples, and with linear ones; with bicubic samples of linear splats it hides .11 % of itself.
double sampling_bias(std::uint32_t sampling);

/// The integral at virtual slice coordinate `at`, from its values at slices' centers.
double sampled_integral(const std::function<double(int slice)>& value, double at, std::uint32_t sampling);
/// Of a volume without a warp: 0 in front of it, the last value behind.
double sampled_integral(std::span<const double> integral, double at, std::uint32_t sampling);

}  // namespace strata::transparency
