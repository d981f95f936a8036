// Every fragment of a frame, per sample, rasterized in double: coverage by the top-left rule on positions snapped to 1/256
// pixel, as the device does; samples whose coverage hangs on less than one snap step are marked undecided.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame.h"
#include "passes/reference/image.h"

namespace strata {

/// A transparent event: L_out = p + e + t L_behind. Fog is already in it (transparency chapter 0.4).
struct Fragment {
    double depth = 0;            ///< view z in metres, depth offset applied: what ordering uses
    glm::dvec3 color{0};         ///< premultiplied scattered radiance p
    glm::dvec3 transmittance{1}; ///< t per channel
    glm::dvec3 emission{0};      ///< e, added without coverage
    double alpha = 0;            ///< scalar coverage
    std::uint32_t submission = 0;///< later submissions are nearer at equal depth
};

/// A point of a triangle under a sample, before any shading.
struct RasterPoint {
    std::uint32_t x = 0, y = 0, sample = 0;
    std::uint32_t draw = 0;      ///< index into Frame::draws, or draws.size() + emitter
    std::uint32_t triangle = 0;  ///< within the draw (particle * 2 + half for emitters)
    glm::dvec3 barycentric{0};   ///< perspective-correct, at the sample (or at the pixel's center, see RasterOptions)
    double depth = 0;            ///< device depth near / z at the sample
    bool front_facing = true;
    bool undecided = false;
};

enum class ShadeAt { sample, pixel_center };
struct RasterOptions {
    ShadeAt shade_at = ShadeAt::sample;
};

/// Calls `visit` for every covered sample of the given draws, in submission order within each pixel row. Not thread safe
/// towards `visit` between different rows: rows run in parallel.
void rasterize(const Frame&, std::span<const std::uint32_t> draws, RasterOptions, const std::function<void(const RasterPoint&)>& visit);

/// The transparent fragments of every sample.
class FragmentLists {
public:
    FragmentLists(std::uint32_t width, std::uint32_t height, std::uint32_t samples);
    std::span<const Fragment> at(std::uint32_t x, std::uint32_t y, std::uint32_t sample = 0) const;
    bool undecided(std::uint32_t x, std::uint32_t y, std::uint32_t sample = 0) const;
    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    std::uint32_t samples() const { return samples_; }
    std::uint64_t total() const { return total_; }
    std::uint32_t deepest() const;

private:
    friend FragmentLists transparent_fragments(const Frame&, const ReferenceImage&);
    std::uint32_t width_, height_, samples_;
    std::uint64_t total_ = 0;
    std::vector<std::vector<Fragment>> lists_;
    std::vector<bool> undecided_;
};

/// Fragments in front of `depth` (device depth per sample, reversed: layer = sample), in submission order, dropped and
/// sanitized as transparency chapter 0.2 says.
FragmentLists transparent_fragments(const Frame&, const ReferenceImage& depth);

}  // namespace strata
