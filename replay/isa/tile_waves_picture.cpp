// Tiles in the colors of their waves, with a legend.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/ranges.h>

#include "replay/isa/tile_waves.h"
#include "replay/plural.h"

namespace strata {
namespace {

constexpr Rgb paper(24, 24, 28), ink(235, 235, 235), faint(150, 150, 155);
constexpr int gap = 12;
// At least this wide: a line of the legend then fits.
constexpr int least_width = 960;

/// Twice the waves are one step: what few waves hide counts most.
Rgb color_of(double waves, const GpuModel& model) { return magma(std::log2(1 + waves) / std::log2(1. + model.unit->wave_slots)); }

struct LegendEntry {
    std::uint64_t tiles = 0;
    std::vector<std::uint32_t> variants;
    std::set<std::string_view> limits;
};

/// By waves per SIMD, of variants that shade anything.
std::map<double, LegendEntry> legend_of(const TileWaves& waves) {
    std::map<double, LegendEntry> legend;
    for (const VariantWaves& variant : waves.variants) {
        if (variant.tiles == 0) continue;
        LegendEntry& entry = legend[variant.occupancy.waves_per_simd];
        entry.tiles += variant.tiles;
        entry.variants.push_back(variant.number);
        entry.limits.insert(name(variant.occupancy.limit));
    }
    return legend;
}

void draw_legend(Canvas& canvas, int top, const TileWaves& waves, const GpuModel& model) {
    for (const auto& [value, entry] : legend_of(waves)) {
        const Box swatch{gap, top, 3 * Canvas::line, Canvas::line - 4};
        canvas.fill(swatch, color_of(value, model));
        canvas.outline(swatch, faint);
        const std::string text = fmt::format("{} waves per SIMD: {} ({:.1f} %), by {}: {} {}", value, plural(entry.tiles, "tile"),
                                             100 * double(entry.tiles) / double(waves.tiles), fmt::join(entry.limits, ", "),
                                             waves.constant, fmt::join(entry.variants, ", "));
        const int left = 2 * gap + swatch.width;
        canvas.text(text, {left, top + 3, canvas.width() - left - gap, 0}, ink);
        top += Canvas::line;
    }
}

}  // namespace

Canvas tile_waves_picture(const TileWaves& waves, const GpuModel& model) {
    const Extent extent = waves.picture.shape.extent;
    const int width = static_cast<int>(extent.width), height = static_cast<int>(extent.height);
    const int zoom = std::max(1, (least_width + width - 1) / width), top = 2 * gap + Canvas::line;
    const int lines = static_cast<int>(legend_of(waves).size());
    Canvas canvas(width * zoom + 2 * gap, top + height * zoom + 2 * gap + lines * Canvas::line, paper);
    canvas.text(fmt::format("{}: {:.2f} of {} waves per SIMD over {}", model.name, waves.mean, model.unit->wave_slots,
                            plural(waves.tiles, "tile")),
                {gap, gap, canvas.width() - 2 * gap, 0}, ink);
    for (std::uint32_t y = 0; y < extent.height; ++y)
        for (std::uint32_t x = 0; x < extent.width; ++x)
            canvas.fill({gap + static_cast<int>(x) * zoom, top + static_cast<int>(y) * zoom, zoom, zoom},
                        color_of(texel(waves.picture, x, y).x, model));
    draw_legend(canvas, top + height * zoom + gap, waves, model);
    return canvas;
}

}  // namespace strata
