// Feature spectra and their modes as JSON, for tools that build shaders.
#include <nlohmann/json.hpp>

#include "replay/json_text.h"
#include "replay/spectra/spectra.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

ordered_json names_of(std::uint32_t features) {
    ordered_json names = ordered_json::array();
    for (std::uint32_t bit = 0; bit < lighting::feature_names().size(); ++bit)
        if ((features >> bit & 1) != 0) names.push_back(lighting::feature_names()[bit]);
    return names;
}

ordered_json json_of(const lighting::SpectrumRow& row) {
    const std::uint32_t unused = lighting::superfluous(row.features, row.spectrum);
    return {{"spectrum", row.spectrum}, {"features", names_of(row.spectrum)}, {"tiles", row.tiles},
            {"mode", row.mode},         {"mode_features", row.features},      {"superfluous", names_of(unused)}};
}

ordered_json json_of(std::span<const lighting::SpectrumRow> rows) {
    ordered_json list = ordered_json::array();
    for (const lighting::SpectrumRow& row : rows) list.push_back(json_of(row));
    return list;
}

ordered_json modes_of(const SpectraReport& report) {
    ordered_json modes = ordered_json::array();
    for (std::uint32_t i = 0; i < report.found.modes.size(); ++i) {
        const lighting::Mode& mode = report.found.modes[i];
        std::uint64_t tiles = 0;
        for (const lighting::SpectrumRow& row : report.rows)
            if (row.mode == i) tiles += row.tiles;
        modes.push_back(
            {{"mode", i}, {"bits", mode.features}, {"features", names_of(mode.features)}, {"cost", mode.cost}, {"tiles", tiles}});
        if (report.costs.waves) modes.back()["waves_per_simd"] = report.costs.waves(mode.features);
    }
    return modes;
}

}  // namespace

std::string as_json(const SpectraReport& report) {
    ordered_json json{
        {"schema", "strata.spectra"},
        {"schema_version", 1},
        {"technique", report.technique->name},
        {"cost", report.cost_source},
        {"unit", report.costs.unit},
        {"aim", report.wish.aim == lighting::Aim::sum ? "sum" : "worst"},
        {"dispatch", report.wish.dispatch},
        {"modes", modes_of(report)},
        {"proven", report.found.proven},
        {"swaps", report.found.swaps},
        {"predicted",
         {{"full", report.full}, {"as_replayed", report.as_replayed}, {"modes", report.by_modes}, {"ideal", report.ideal}}},
        {"spectra", json_of(report.rows)},
        {"frames", ordered_json::array()}};
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
