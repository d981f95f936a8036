// Feature spectra and their modes for a terminal.
#include <set>

#include <fmt/ranges.h>

#include "passes/technique.h"
#include "replay/plural.h"
#include "replay/spectra/spectra.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

double share(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

std::uint64_t all_tiles(const SpectraReport& report) {
    std::uint64_t tiles = 0;
    for (const lighting::SpectrumRow& row : report.rows) tiles += row.tiles;
    return tiles;
}

/// "Shadows in 600, Tube in 2917": features that tiles of the mode have no use for.
std::string superfluous_text(std::span<const lighting::SpectrumRow> rows, std::uint32_t mode) {
    const auto names = lighting::feature_names();
    std::vector<std::string> parts;
    for (std::uint32_t bit = 0; bit < names.size(); ++bit) {
        std::uint64_t tiles = 0;
        for (const lighting::SpectrumRow& row : rows)
            if (row.mode == mode && (lighting::superfluous(row.features, row.spectrum) >> bit & 1) != 0) tiles += row.tiles;
        if (tiles > 0) parts.push_back(fmt::format("{} in {}", names[bit], tiles));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string modes_text(const SpectraReport& report) {
    std::string text;
    for (std::uint32_t i = 0; i < report.found.modes.size(); ++i) {
        const lighting::Mode& mode = report.found.modes[i];
        std::uint64_t tiles = 0;
        for (const lighting::SpectrumRow& row : report.rows)
            if (row.mode == i) tiles += row.tiles;
        text += fmt::format("mode {:2}  0x{:04x}  cost {}  {} ({:.1f} %){}\n", i, mode.features, short_number(mode.cost),
                            plural(tiles, "tile"), share(double(tiles), double(all_tiles(report))),
                            report.costs.waves ? fmt::format("  {} waves per SIMD", report.costs.waves(mode.features)) : "");
        text += wrapped("    ", mode.features == 0 ? "no feature" : lighting::braced_names(mode.features));
        if (const std::string unused = superfluous_text(report.rows, i); !unused.empty())
            text += wrapped("    ", "superfluous: " + unused);
    }
    return text;
}

std::string prediction_text(const SpectraReport& report) {
    const auto line = [&](std::string_view what, double cost) {
        return fmt::format("    {:40} {:>9} {:6.1f} %\n", what, short_number(cost), share(cost, report.full));
    };
    std::string text = fmt::format("Predicted ({}{}):\n", report.costs.unit,
                                   report.wish.aim == lighting::Aim::worst ? ", of the worst frame" : "");
    text += line("one full mode", report.full) + line("the modes it was replayed with", report.as_replayed);
    // A mode that only saves arithmetic, beside a larger one with room for as many waves, is not looked for.
    const std::string_view best = report.costs.waves ? "the best for waves" : "the best";
    text += line(fmt::format("{}, {}", plural(report.found.modes.size(), "mode"),
                             report.found.proven ? fmt::format("proven {}", best) : fmt::format("{} found", best)),
                 report.by_modes);
    text += line("a mode for every spectrum", report.ideal);
    if (report.costs.waves && report.as_replayed < report.by_modes)
        text += "    the modes it was replayed with also save arithmetic where waves stay the same: not looked for here\n";
    return text;
}

/// Waves per SIMD of the full mode and, weighted by tiles, of the modes that were found.
std::string waves_text(const SpectraReport& report) {
    const auto mean = mean_waves(report);
    if (!mean) return "";
    return fmt::format("    {:40} {} of one full mode, {:.2f} of these by tiles\n", "waves per SIMD",
                       report.costs.waves(every_light_feature), *mean);
}

}  // namespace

std::string as_text(const SpectraReport& report) {
    std::set<std::string> captures;
    for (const FrameSpectra& frame : report.frames) captures.insert(frame.capture);
    std::string text = fmt::format(
        "{}: {} of {}, {} with something to light, {}; costs: {}\n\n", report.technique->name,
        plural(report.frames.size(), "frame"), plural(captures.size(), "capture"), plural(all_tiles(report), "tile"),
        report.rows.size() == 1 ? std::string("1 spectrum") : fmt::format("{} spectra", report.rows.size()), report.cost_source);
    text += modes_text(report) + "\n" + prediction_text(report) + waves_text(report) +
            "\nThe most frequent spectra by these modes:\n";
    text += lighting::readout(report.rows);
    text += fmt::format("\nTo replay with them: --use {}", report.technique->name);
    std::vector<std::uint32_t> modes;
    for (const lighting::Mode& mode : report.found.modes) modes.push_back(mode.features);
    for (const ModeSetting& setting : settings_of(*report.technique, modes)) text += " --set " + setting.text();
    return text + "\n";
}

}  // namespace strata
