// Pre-exposure: the factor by which the light of a frame is multiplied before any of it is stored, so that half floats hold a sun
// in lux as well as a candle. As in engines (S. Lagarde, C. de Rousiers, "Moving Frostbite to Physically Based Rendering 3.0",
// SIGGRAPH 2014, 5.1.2), it is the exposure: what is white in the picture is about 1 in every image.
#pragma once

#include <optional>

namespace strata {

struct Frame;  // capture_format/frame.h

/// The factor for a frame as recorded: its exposure, unless that leaves white_level() where half floats are coarse or end; then
/// 1 / white_level(). More light and less exposure by the same factor give the same products. Positive and finite.
double pre_exposure(const Frame&);

/// About the radiance of a white surface: in sun, sky and fog, and under each light alone at a quarter of its range or, where
/// that is nearer, as far as the middle of the scene (a light without an end has a range beyond it). Nothing where no light is
/// recorded. In the unit of the frame's light, pre-exposed or not.
std::optional<double> white_level(const Frame&);

/// Multiplies lights, sky, fog, background and emission by the factor and divides the exposure by it. What has no radiance of its
/// own in a frame (the base color of unlit materials is radiance only to those who shade it) is read with Frame::pre_exposure.
void pre_expose(Frame&, double factor);

}  // namespace strata
