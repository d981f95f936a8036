// Every fragment of a frame, per sample, rasterized in double: coverage by the top-left rule on positions snapped to 1/256
// pixel, as the device does; samples whose coverage hangs on less than one snap step are marked undecided.
//
// Front faces: the outward side of a triangle (a, b, c) is where cross(b - a, c - a) points in object space, carried to view
// space by the inverse transpose of object-to-view. That is glTF's rule, and a mirrored transform needs no special case.
// Back faces of opaque and masked single-sided draws are culled; transparent and double-sided draws keep both.
//
// Particles are quads in the view plane: corners 0..3 at (-1,-1), (1,-1), (1,1), (-1,1) times size in view x (right) and y (up),
// turned counter-clockwise by rotation; triangles 0-1-2 and 0-2-3; uv of corner 3 is uv_frame's left top, v grows downwards,
// so corner 0 has (left, top + height). They are front facing, their normal is (0, 0, -1).
//
// Jitter is added to clip space x / w and y / w, y down: positive jitter moves the image right and down.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "passes/reference/image.h"

namespace strata {

struct Frame;  // capture_format/frame.h
struct View;   // capture_format/view.h

/// A transparent fragment: L_out = p + e + t L_behind. Fog is already in it (docs/algorithms/transparency.md 0.4).
struct Fragment {
    double depth = 0;              ///< view z in meters, depth offset applied, or an interface layer's: what ordering uses
    glm::dvec3 color{0};           ///< premultiplied scattered radiance p
    glm::dvec3 transmittance{1};   ///< t per channel
    glm::dvec3 emission{0};        ///< e, added without coverage
    double alpha = 0;              ///< scalar coverage
    glm::dvec2 distortion{0};      ///< d, in uv: how far from here what is behind is seen, added without coverage
    double fog = 1;                ///< share of its radiance that reaches the eye through the fog before it
    double soft_fade = 0;          ///< meters over which its particle fades before opaque surfaces; 0 is hard
    std::uint32_t layer = 0;       ///< of interfaces, of which `depth` is made; 0 the world
    std::uint32_t submission = 0;  ///< later submissions are nearer at equal depth; one number per triangle
    bool may_be_absent = false;    ///< rounding decides whether it is there
    bool is_level = true;          ///< its triangle has one device depth, which every device finds everywhere on it
};

/// A fragment that is not there, but that rounding may put there.
struct NearMiss {
    std::uint32_t slot = 0;  ///< x * samples + sample
    Fragment fragment;
    std::optional<std::uint32_t> instead_of;  ///< submission of the fragment in whose place it is, if it is: one of both is there
};

/// A point of a triangle under a sample, before any shading.
struct RasterPoint {
    std::uint32_t x = 0, y = 0, sample = 0;
    std::uint32_t draw = 0;      ///< index into Frame::draws, or draws.size() + emitter
    std::uint32_t triangle = 0;  ///< within the draw (particle * 2 + half for emitters)
    glm::dvec3 barycentric{0};   ///< perspective-correct, at the sample (or at the pixel's center, see RasterOptions)
    double depth = 0;            ///< device depth near / z at the sample
    double depth_slope = 0;      ///< how much device depth changes per pixel, in x or y
    bool front_facing = true;
    bool covered = true;  ///< false: a near miss
    bool undecided = false;
    std::uint32_t near_sides = 0;  ///< of its triangle, so near that either of their sides may have the sample
};

enum class ShadeAt { sample, pixel_center };
struct RasterOptions {
    ShadeAt shade_at = ShadeAt::sample;
    bool near_misses = false;  ///< visit samples, too, that are outside by less than is undecided (covered = false)
    bool near_seams = false;   ///< seams of a mesh are sides like others: which of two triangles covers a sample is asked
};

/// Calls `visit` for every covered sample of the given draws, in submission order within each pixel row. Not thread safe
/// towards `visit` between different rows: rows run in parallel.
void rasterize(const Frame&, std::span<const std::uint32_t> draws, RasterOptions,
               const std::function<void(const RasterPoint&)>& visit);

/// Whether some side of some triangle is within so many steps of 1/256 pixel of a sample, so that its coverage is another one
/// where positions are snapped to steps as coarse. Indexed as texels, layer = sample.
std::vector<bool> samples_near_sides(const Frame&, double steps);

/// Opaque and masked draws, in submission order.
std::vector<std::uint32_t> opaque_draws(const Frame&);
/// Transparent draws in submission order, then one index per emitter.
std::vector<std::uint32_t> transparent_draws(const Frame&);

/// The nearest surface under every sample.
struct VisiblePoints {
    std::uint32_t width = 0, height = 0, samples = 1;
    std::vector<RasterPoint> points;  ///< depth 0 and draw no_index where there is no surface; `undecided` is set there, too
    std::vector<RasterPoint> rivals;  ///< which else may be the nearest of an undecided sample, in the order of samples; likewise

    std::size_t index(std::uint32_t x, std::uint32_t y, std::uint32_t sample = 0) const {
        return (std::size_t(sample) * height + y) * width + x;
    }
    const RasterPoint& at(std::uint32_t x, std::uint32_t y, std::uint32_t sample = 0) const {
        return points[index(x, y, sample)];
    }
};

/// Depth test GREATER_OR_EQUAL in submission order. Masked points below their cutoff are not there. Undecided: coverage,
/// two depths within float rounding (or within what a snap step of a slope makes of them), or an alpha on its cutoff.
VisiblePoints visible_points(const Frame&, std::span<const std::uint32_t> draws,
                             RasterOptions = {.shade_at = ShadeAt::pixel_center});

/// What reaches a place beside the light of lights and hemisphere, view space: irradiance / pi on a surface with that normal,
/// mean radiance of all directions where the normal is 0. Empty: nothing.
using LightAround = std::function<glm::dvec3(const glm::dvec3& position, const glm::dvec3& normal)>;

/// Rows of pixels from `begin` up to `end`, counted from the top.
struct PixelRows {
    std::uint32_t begin = 0, end = ~0u;
};

/// The transparent fragments of a row of pixels: the lists of its samples (x * samples + sample) after each other.
struct FragmentRow {
    std::vector<Fragment> fragments;
    std::vector<std::size_t> begin;  ///< one more than there are samples in the row
    std::vector<std::uint8_t> undecided;
    std::vector<NearMiss> near_misses;  ///< by slot

    std::span<const Fragment> at(std::size_t slot) const {
        return std::span(fragments).subspan(begin[slot], begin[slot + 1] - begin[slot]);
    }
};

/// The transparent fragments of a frame row by row, for callers that need no two rows at once: all of them are large.
class FragmentRows {
public:
    /// Frame and depth must outlive it. Device depth as for transparent_fragments().
    FragmentRows(const Frame&, const ReferenceImage& depth, LightAround = {}, std::span<const std::uint32_t> draws = {});
    FragmentRows(FragmentRows&&) noexcept;
    ~FragmentRows();

    /// Fills a row whose memory may be reused. Thread safe. Whether an order hangs on rounding is not looked at.
    void fill(std::uint32_t y, FragmentRow&) const;
    const View& view() const;

private:
    struct Scene;
    std::unique_ptr<const Scene> scene_;
};

/// The transparent fragments of every sample.
class FragmentLists {
public:
    FragmentLists(std::uint32_t width, std::uint32_t height, std::uint32_t samples);
    std::span<const Fragment> at(std::uint32_t x, std::uint32_t y, std::uint32_t sample = 0) const;
    bool undecided(std::uint32_t x, std::uint32_t y, std::uint32_t sample = 0) const;
    std::span<const NearMiss> near_misses(std::uint32_t x, std::uint32_t y, std::uint32_t sample = 0) const;
    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }
    std::uint32_t samples() const { return samples_; }
    std::uint64_t total() const;
    /// The most fragments of one sample.
    std::uint32_t deepest() const;
    /// Multiplies radiance.
    void scale_light(double factor);

private:
    friend FragmentLists transparent_fragments(const Frame&, const ReferenceImage&, PixelRows, LightAround,
                                               std::span<const std::uint32_t>);
    std::uint32_t width_, height_, samples_;
    std::vector<FragmentRow> rows_;
};

/// Whether the result depends on the order of two fragments next to each other, whose depths a float cannot tell apart. Ties of
/// level triangles are decided by submission; of tilted ones in one plane floats decide. Fragments that cover nothing commute.
bool order_is_undecided(const Fragment& nearer, const Fragment& farther);

/// Fragments in front of `depth` (device depth per sample, reversed: layer = sample), in submission order, dropped and
/// sanitized as docs/algorithms/transparency.md 0.2 says, shaded at the sample. Undecided: coverage, the depth test, or the order
/// of two that do not commute hangs on float rounding.
/// Lists of other rows than those given stay empty. `draws` are rasterized alone, in their order; empty: transparent_draws().
FragmentLists transparent_fragments(const Frame&, const ReferenceImage& depth, PixelRows = {}, LightAround = {},
                                    std::span<const std::uint32_t> draws = {});

}  // namespace strata
