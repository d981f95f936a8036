// What modes and spectra say of themselves in JSON, CSV and Markdown; text has them as paragraphs (as_text.cpp).
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "replay/json_text.h"
#include "replay/spectra/spectra.h"
#include "replay/tables/document.h"

namespace strata {
namespace {

using lighting::SpectrumRow;
using nlohmann::ordered_json;

/// A mode that was found, with the tiles that it shades.
struct FoundMode {
    std::uint32_t number = 0, features = 0;
    double cost = 0, share = 0;
    std::uint64_t tiles = 0;
    std::optional<std::uint64_t> waves;
};

std::vector<FoundMode> modes_of(const SpectraReport& report) {
    std::vector<FoundMode> modes;
    std::uint64_t all = 0;
    for (const SpectrumRow& row : report.rows) all += row.tiles;
    for (std::uint32_t i = 0; i < report.found.modes.size(); ++i) {
        const lighting::Mode& mode = report.found.modes[i];
        FoundMode& found = modes.emplace_back(FoundMode{.number = i, .features = mode.features, .cost = mode.cost, .waves = {}});
        for (const SpectrumRow& row : report.rows)
            if (row.mode == i) found.tiles += row.tiles;
        found.share = all > 0 ? double(found.tiles) / double(all) : 0;
        if (report.costs.waves) found.waves = report.costs.waves(mode.features);
    }
    return modes;
}

Sheet sheet_of_spectra(std::span<const SpectrumRow> rows) {
    const auto count = [](std::string key, std::string help, auto member) {
        return Column<SpectrumRow>{
            {.key = key, .title = key, .help = std::move(help), .kind = CellKind::count, .shown = in_files},
            [member](const SpectrumRow& row) { return std::uint64_t{row.*member}; }};
    };
    const std::vector<Column<SpectrumRow>> columns{
        count("spectrum", "features that the tiles need, as bits", &SpectrumRow::spectrum),
        count("tiles", "tiles that need them", &SpectrumRow::tiles), count("mode", "mode that shades them", &SpectrumRow::mode),
        count("mode_features", "its features as bits", &SpectrumRow::features)};
    return sheet_of<SpectrumRow>(columns, rows, [](const SpectrumRow&) { return RowName(); });
}

ordered_json names_of(std::uint32_t features) {
    ordered_json names = ordered_json::array();
    for (std::uint32_t bit = 0; bit < lighting::feature_names().size(); ++bit)
        if ((features >> bit & 1) != 0) names.push_back(lighting::feature_names()[bit]);
    return names;
}

ordered_json json_of(std::span<const SpectrumRow> rows) {
    ordered_json list = rows_json(sheet_of_spectra(rows));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        list[i]["features"] = names_of(rows[i].spectrum);
        list[i]["superfluous"] = names_of(lighting::superfluous(rows[i].features, rows[i].spectrum));
    }
    return list;
}

ordered_json json_of_modes(const SpectraReport& report) {
    ordered_json list = rows_json(sheet_of(report));
    for (std::size_t i = 0; i < list.size(); ++i) list[i]["features"] = names_of(report.found.modes[i].features);
    return list;
}

ordered_json head_of(const SpectraReport& report) {
    ordered_json json = document({.schema = "strata.spectra", .date = report.date});
    json.update(
        {{"technique", report.technique->name},
         {"cost", report.cost_source},
         {"unit", report.costs.unit},
         {"aim", report.wish.aim == lighting::Aim::sum ? "sum" : "worst"},
         {"dispatch", report.wish.dispatch},
         {"modes", json_of_modes(report)},
         {"proven", report.found.proven},
         {"swaps", report.found.swaps},
         {"predicted",
          {{"full", report.full}, {"as_replayed", report.as_replayed}, {"modes", report.by_modes}, {"ideal", report.ideal}}},
         {"spectra", json_of(report.rows)},
         {"frames", ordered_json::array()}});
    return json;
}

}  // namespace

Sheet sheet_of(const SpectraReport& report) {
    const std::vector<Column<FoundMode>> columns{
        {{.key = "mode", .title = "mode", .help = "number of the mode", .kind = CellKind::count, .shown = in_files},
         [](const FoundMode& mode) { return std::uint64_t{mode.number}; }},
        {{.key = "bits", .title = "bits", .help = "its features as bits", .kind = CellKind::count, .digits = "#06x"},
         [](const FoundMode& mode) { return std::uint64_t{mode.features}; }},
        {{.key = "features",
          .title = "features",
          .help = "their names; a list in JSON",
          .kind = CellKind::text,
          .shown = in_text | in_csv},
         [](const FoundMode& mode) { return lighting::braced_names(mode.features); }},
        {{.key = "cost", .title = "cost", .help = "cost of a tile, in the unit of the costs", .better = Better::less},
         [](const FoundMode& mode) { return mode.cost; }},
        {{.key = "tiles", .title = "tiles", .help = "tiles that it shades", .kind = CellKind::count},
         [](const FoundMode& mode) { return mode.tiles; }},
        {{.key = "share_of_tiles",
          .title = "% of tiles",
          .help = "the same as a share",
          .kind = CellKind::share,
          .digits = ".1f"},
         [](const FoundMode& mode) { return mode.share; }},
        {{.key = "waves_per_simd",
          .title = "waves per SIMD",
          .help = "waves that a SIMD holds of it, where the costs know them",
          .kind = CellKind::count,
          .better = Better::more,
          .if_any = true},
         [](const FoundMode& mode) { return cell_or_nothing(mode.waves); }}};
    return sheet_of<FoundMode>(columns, modes_of(report), [](const FoundMode& mode) {
        return RowName{"", fmt::format("mode {}", mode.number)};
    });
}

std::string as_csv(const SpectraReport& report) {
    std::vector<Sheet> sheets{sheet_of(report), sheet_of_spectra(report.rows)};
    sheets[0].of_every_row = {{"table", "modes"}};
    sheets[1].of_every_row = {{"table", "spectra"}};
    return as_csv(sheets);
}

Page page_of(const SpectraReport& report) { return {as_text(report), sheet_of(report)}; }

std::string as_json(const SpectraReport& report) {
    ordered_json json = head_of(report);
    for (const FrameSpectra& frame : report.frames)
        json["frames"].push_back({{"capture", frame.capture}, {"frame", frame.frame}, {"spectra", json_of(frame.rows)}});
    if (const auto mean = mean_waves(report)) json["mean_waves_per_simd"] = *mean;
    for (const TimedMode& mode : report.costs.timed)
        json["timed"].push_back({{"bits", mode.features}, {"tiles", mode.tiles}, {"saved_ms", mode.saved_ms}});
    for (const auto& [bits, mode] : report.costs.compiled)
        json["compiled"].push_back({{"bits", bits}, {"cycles", mode.cycles}, {"waves_per_simd", mode.waves}});
    std::vector<std::uint32_t> modes;
    for (const lighting::Mode& mode : report.found.modes) modes.push_back(mode.features);
    for (const ModeSetting& setting : settings_of(*report.technique, modes)) json["settings"].push_back(setting.text());
    return json_text(json);
}

}  // namespace strata
