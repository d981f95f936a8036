// Feature spectra (docs/algorithms/lighting.md 3; Kircher, Rendering Technology in Agents of Mayhem, GDC 2018): what a tile's
// surviving lights and surfaces need, as bits of light_features.shared.h, and the few shading modes, each compiled for a fixed
// set of bits, that serve them. A mode serves every spectrum that is a subset of its bits.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strata::lighting {

/// Names of the bits, in the order of light_features.shared.h.
std::span<const std::string_view> feature_names();

/// "{Blockers, Square Spot}", in the order in which the talk lists them.
std::string braced_names(std::uint32_t features);
/// The same of a spectrum: one without a bit is "<Nothin' Special>".
std::string spectrum_text(std::uint32_t spectrum);

/// Tiles by their spectrum.
using Histogram = std::map<std::uint32_t, std::uint64_t>;
std::uint64_t tiles_of(const Histogram&);

/// Whether the mode has every bit that the spectrum needs.
inline bool serves(std::uint32_t mode, std::uint32_t spectrum) { return (spectrum & ~mode) == 0; }
/// Bits that the mode was compiled with and the spectrum does not need.
inline std::uint32_t superfluous(std::uint32_t mode, std::uint32_t spectrum) { return mode & ~spectrum; }

/// A mode and what a tile shaded by it costs, in any unit.
struct Mode {
    std::uint32_t features = 0;
    double cost = 0;
};

inline constexpr std::uint8_t no_mode = 0xff;
/// The cheapest mode that serves the spectrum, of equal ones the first; no_mode where none does. At most 255 modes.
std::uint8_t choose(std::span<const Mode>, std::uint32_t spectrum);
/// The same for each of the 65536 spectra, by one sweep over the supersets per bit instead of a search per spectrum.
std::vector<std::uint8_t> mode_table(std::span<const Mode>);

/// Tiles of one spectrum and the mode that shades them.
struct SpectrumRow {
    std::uint32_t spectrum = 0;
    std::uint64_t tiles = 0;
    std::uint32_t mode = 0;      ///< its index
    std::uint32_t features = 0;  ///< the mode's bits
};
/// Most tiles first, then the smaller spectrum. Every spectrum must have a mode that serves it.
std::vector<SpectrumRow> sorted_rows(const Histogram&, std::span<const Mode>);

/// The talk's read-out of the most frequent spectra, a line each:
/// "(1) 2917 tiles {Blockers, Portals}, shading mode 6, superfluous {Shadows, Square Spot, Tube}".
std::string readout(std::span<const SpectrumRow>, std::size_t lines = 3);

}  // namespace strata::lighting
