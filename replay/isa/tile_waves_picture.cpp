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

struct LegendLine {
    Rgb color;
    std::string text;
};

std::vector<LegendLine> legend_lines(const TileWaves& waves, const GpuModel& model) {
    std::vector<LegendLine> lines;
    for (const auto& [value, entry] : legend_of(waves)) {
        std::vector<std::uint32_t> variants = entry.variants;
        std::ranges::sort(variants);
        lines.push_back(
            {color_of(value, model), fmt::format("{} waves per SIMD: {} ({:.1f} %), limited by {}: {} {}", value,
                                                 plural(entry.tiles, "tile"), 100 * double(entry.tiles) / double(waves.tiles),
                                                 fmt::join(entry.limits, ", "), waves.constant, fmt::join(variants, ", "))});
    }
    const Extent extent = waves.picture.shape.extent;
    for (std::uint32_t i = 0; i < extent.width * extent.height; ++i)
        if (texel(waves.picture, i % extent.width, i / extent.width).x <= 0) {
            lines.push_back({color_of(0, model), fmt::format("nothing is shaded")});  // of a literal GCC 12 warns
            break;
        }
    return lines;
}

void draw_legend(Canvas& canvas, int top, const std::vector<LegendLine>& lines) {
    for (const LegendLine& line : lines) {
        const Box swatch{gap, top, 3 * Canvas::line, Canvas::line - 4};
        canvas.fill(swatch, line.color);
        canvas.outline(swatch, faint);
        const int left = 2 * gap + swatch.width;
        canvas.text(line.text, {left, top + 3, canvas.width() - left - gap, 0}, ink);
        top += Canvas::line;
    }
}

}  // namespace

Canvas tile_waves_picture(const TileWaves& waves, const GpuModel& model) {
    const Extent extent = waves.picture.shape.extent;
    const int width = static_cast<int>(extent.width), height = static_cast<int>(extent.height);
    const int zoom = enlargement(width, height, least_width);
    const int top = 2 * gap + Canvas::line;
    const std::vector<LegendLine> lines = legend_lines(waves, model);
    Canvas canvas(std::max(least_width, width * zoom) + 2 * gap,
                  top + height * zoom + 2 * gap + static_cast<int>(lines.size()) * Canvas::line, paper);
    canvas.text(fmt::format("GPU model {}: {:.2f} of {} waves per SIMD, the mean over {}", model.name, waves.mean,
                            model.unit->wave_slots, plural(waves.tiles, "shaded tile")),
                {gap, gap, canvas.width() - 2 * gap, 0}, ink);
    for (std::uint32_t y = 0; y < extent.height; ++y)
        for (std::uint32_t x = 0; x < extent.width; ++x)
            canvas.fill({gap + static_cast<int>(x) * zoom, top + static_cast<int>(y) * zoom, zoom, zoom},
                        color_of(texel(waves.picture, x, y).x, model));
    draw_legend(canvas, top + height * zoom + gap, lines);
    return canvas;
}

}  // namespace strata
