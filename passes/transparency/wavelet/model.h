// The technique in double precision: as the column of cells that the Haar coefficients stand for (docs/algorithms/transparency.md
// 5: the master test), except where the storage rounds the coefficients themselves.
#pragma once

#include <optional>
#include <span>

#include "passes/transparency/functions/model.h"
#include "passes/transparency/wavelet/wavelet.shared.h"

namespace strata {

class Settings;  // passes/settings.h

}  // namespace strata

namespace strata::transparency {

/// A fragment of optical depth at a place from 0 to N - 1, in cells.
struct CellFragment {
    double place = 0, optical_depth = 0;
};

/// The coefficients in heap order, the scaling coefficient last. With `half` they are half floats, rounded at every addition.
std::vector<double> haar_coefficients(std::uint32_t rank, std::span<const CellFragment>, std::optional<Rounding> half = {});
/// Optical depth in front of a place, mixed from two cells.
double haar_depth(std::span<const double> coefficients, double place);

/// The same without wavelets: every fragment splatted linearly on two slices, summed up, read linearly with a bias of one slice.
double voxel_column_depth(std::uint32_t slices, std::span<const CellFragment>, double place);

ImageSet wavelet_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
