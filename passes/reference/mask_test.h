// The nearest surface under every sample, where something else than the cutoff decides which samples a masked surface covers.
#pragma once

#include <functional>

#include "passes/reference/fragments.h"

namespace strata {

/// Whether a masked surface covers a sample; `maybe` where a float may decide otherwise.
enum class MaskCover { cut, kept, maybe_cut, maybe_kept };

/// Asked for samples of masked surfaces alone. Called from several threads.
using MaskTest = std::function<MaskCover(const RasterPoint&)>;

/// Alpha against the material's cutoff at the point itself.
MaskTest cutoff_test(const Frame&);

/// As the one of fragments.h, with another test.
VisiblePoints visible_points(const Frame&, std::span<const std::uint32_t> draws, RasterOptions, const MaskTest&);

}  // namespace strata
