// How much of every pixel masked surfaces cover: the area where alpha of the mask's finest mip reaches the cutoff. No mip that a
// technique filters is read.
#pragma once

#include "passes/image_set.h"

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::gbuffer {

/// Whether draws of the frame are masked.
bool has_masks(const Frame&);

/// Prepares the truth of a frame with masked surfaces for coverage_metrics(). depth_layers, which has one channel, gets three
/// more: the share of the pixel's area where a masked surface is the nearest, the mean alpha of what is before the nearest other
/// surface (1 - the product of 1 - alpha), and per sample the depth of that other surface. ReferenceImage::standard_error has
/// those of the two shares.
///
/// Both are counted by rays at 16 x 16 places of the pixel, each at random in its own 256th, so that none beats with a mask's
/// period. Textures are bilinear at mip 0. The standard error is half of the difference between the places of either color of a
/// chessboard.
void add_true_coverage(ImageSet& truth, const Frame&);

}  // namespace strata::gbuffer
