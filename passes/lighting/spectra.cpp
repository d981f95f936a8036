#include "passes/lighting/spectra.h"

#include <algorithm>
#include <array>
#include <cassert>

#include <fmt/format.h>

#include "passes/shaders/light_features.shared.h"

namespace strata::lighting {
namespace {

constexpr std::array<std::string_view, light_feature_bits> names = {
    "Blockers", "Portals", "Shadows", "Soft Shadows",       "Square Spot", "Round Spot",
    "Omni",     "Tube",    "Area",    "Projected Textures", "Darks",       "Clip Planes",
    "Cloth",    "Skin",    "Hair",    "GI Tap Visibility"};

// The read-out on the talk's slide has projected textures, area lights and tubes in this order; the others follow their bits.
constexpr std::array<std::uint32_t, light_feature_bits> order_of_the_talk = {0, 1, 2,  3,  4,  5,  6,  9,
                                                                             8, 7, 10, 11, 12, 13, 14, 15};

/// Of two indices of modes the one to prefer.
std::uint8_t better(std::span<const Mode> modes, std::uint8_t a, std::uint8_t b) {
    if (a == no_mode || b == no_mode) return std::min(a, b);
    if (modes[a].cost != modes[b].cost) return modes[a].cost < modes[b].cost ? a : b;
    return std::min(a, b);
}

}  // namespace

std::span<const std::string_view> feature_names() { return names; }

std::string braced_names(std::uint32_t features) {
    std::vector<std::string_view> listed;
    for (const std::uint32_t bit : order_of_the_talk)
        if ((features >> bit & 1) != 0) listed.push_back(names[bit]);
    return fmt::format("{{{}}}", fmt::join(listed, ", "));
}

std::string spectrum_text(std::uint32_t spectrum) { return spectrum == 0 ? "<Nothin' Special>" : braced_names(spectrum); }

std::uint64_t tiles_of(const Histogram& histogram) {
    std::uint64_t sum = 0;
    for (const auto& [spectrum, tiles] : histogram) sum += tiles;
    return sum;
}

std::uint8_t choose(std::span<const Mode> modes, std::uint32_t spectrum) {
    assert(modes.size() <= no_mode);
    std::uint8_t best = no_mode;
    for (std::size_t i = 0; i < modes.size(); ++i)
        if (serves(modes[i].features, spectrum)) best = better(modes, best, static_cast<std::uint8_t>(i));
    return best;
}

std::vector<std::uint8_t> mode_table(std::span<const Mode> modes) {
    assert(modes.size() <= no_mode);
    std::vector<std::uint8_t> table(std::size_t(1) << light_feature_bits, no_mode);
    for (std::size_t i = 0; i < modes.size(); ++i) {
        std::uint8_t& entry = table[modes[i].features & every_light_feature];
        entry = better(modes, entry, static_cast<std::uint8_t>(i));
    }
    for (std::uint32_t bit = 0; bit < light_feature_bits; ++bit)
        for (std::size_t spectrum = 0; spectrum < table.size(); ++spectrum)
            if ((spectrum >> bit & 1) == 0)
                table[spectrum] = better(modes, table[spectrum], table[spectrum | std::size_t(1) << bit]);
    return table;
}

std::vector<SpectrumRow> sorted_rows(const Histogram& histogram, std::span<const Mode> modes) {
    std::vector<SpectrumRow> rows;
    for (const auto& [spectrum, tiles] : histogram) {
        const std::uint8_t mode = choose(modes, spectrum);
        assert(mode != no_mode);
        rows.push_back({spectrum, tiles, mode, modes[mode].features});
    }
    std::ranges::stable_sort(rows, std::greater(), &SpectrumRow::tiles);
    return rows;
}

std::string readout(std::span<const SpectrumRow> rows, std::size_t lines) {
    std::string text;
    for (std::size_t i = 0; i < std::min(lines, rows.size()); ++i) {
        const SpectrumRow& row = rows[i];
        text +=
            fmt::format("({}) {} {} {}, shading mode {}, superfluous {}\n", i + 1, row.tiles, row.tiles == 1 ? "tile" : "tiles",
                        spectrum_text(row.spectrum), row.mode, braced_names(superfluous(row.features, row.spectrum)));
    }
    return text;
}

}  // namespace strata::lighting
