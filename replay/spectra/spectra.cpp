#include "replay/spectra/spectra.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "passes/technique.h"
#include "replay/session/ability.h"

namespace strata {
namespace {

bool has_feature_modes(const Technique& technique) { return technique.abilities.feature_modes.has_value(); }

/// The column's number of a row.
std::uint32_t at(const NumberTable& table, const std::vector<double>& row, std::string_view column) {
    const auto found = std::ranges::find(table.columns, column, &TableColumn::name);
    assert(found != table.columns.end());
    return static_cast<std::uint32_t>(row[static_cast<std::size_t>(found - table.columns.begin())]);
}

FrameSpectra spectra_of(const NumberTable& table) {
    FrameSpectra made;
    for (const std::vector<double>& row : table.rows) {
        const std::uint32_t spectrum = at(table, row, "spectrum"), tiles = at(table, row, "tiles");
        made.tiles[spectrum] += tiles;
        made.rows.push_back({spectrum, tiles, at(table, row, "mode"), spectrum | at(table, row, "superfluous")});
    }
    return made;
}

std::vector<lighting::Scene> scenes_of(std::span<const FrameSpectra> frames) {
    std::vector<lighting::Scene> scenes;
    for (const FrameSpectra& frame : frames) scenes.push_back({.tiles = frame.tiles});
    return scenes;
}

lighting::Histogram summed(std::span<const FrameSpectra> frames) {
    lighting::Histogram sum;
    for (const FrameSpectra& frame : frames)
        for (const auto& [spectrum, tiles] : frame.tiles) sum[spectrum] += tiles;
    return sum;
}

/// What frames cost, by the wish's aim, whose tiles are shaded as the rows say and that dispatch so many modes.
double cost_of_rows(std::span<const std::vector<lighting::SpectrumRow>> frames, std::size_t modes, const lighting::ModeCost& cost,
                    const SpectraWish& wish) {
    double aimed = 0;
    for (const std::vector<lighting::SpectrumRow>& rows : frames) {
        double sum = wish.dispatch * double(modes);
        for (const lighting::SpectrumRow& row : rows) sum += double(row.tiles) * cost(row.features);
        aimed = wish.aim == lighting::Aim::sum ? aimed + sum : std::max(aimed, sum);
    }
    return aimed;
}

double cost_as_replayed(std::span<const FrameSpectra> frames, const lighting::ModeCost& cost, const SpectraWish& wish) {
    std::vector<std::vector<lighting::SpectrumRow>> rows;
    std::set<std::uint32_t> modes;
    for (const FrameSpectra& frame : frames) {
        rows.push_back(frame.rows);
        for (const lighting::SpectrumRow& row : frame.rows) modes.insert(row.mode);
    }
    return cost_of_rows(rows, modes.size(), cost, wish);
}

/// The modes by what a tile chooses among them on the device: the weights, whatever they were found by.
std::vector<lighting::Mode> as_chosen(std::vector<lighting::Mode> modes) {
    for (lighting::Mode& mode : modes) mode.cost = lighting::weighted_cost(mode.features);
    return modes;
}

/// By feature the union of the spectra that do without it: one that is dear and rare is told from the rest by these alone.
std::vector<std::uint32_t> unions_without_a_feature(const lighting::Histogram& tiles) {
    std::vector<std::uint32_t> unions;
    for (std::uint32_t bit = 0; bit < light_feature_bits; ++bit) {
        std::uint32_t features = 0;
        for (const auto& [spectrum, count] : tiles)
            if ((spectrum >> bit & 1) == 0) features |= spectrum;
        unions.push_back(features);
    }
    return unions;
}

/// Modes that were found by a cost completed from those of others, though their own is to be had.
std::vector<std::uint32_t> guessed_modes(const SpectraReport& report, std::span<const std::uint32_t> asked) {
    std::vector<std::uint32_t> guessed;
    for (const lighting::Mode& mode : report.found.modes)
        if (!report.costs.compiled.empty() && std::ranges::count(asked, mode.features) == 0) guessed.push_back(mode.features);
    return guessed;
}

}  // namespace

Result<const Technique*> technique_of_spectra(const ChoiceChanges& choices) {
    return technique_with({has_feature_modes, "makes no feature spectra"}, choices);
}

std::vector<ModeSetting> settings_of(const Technique& technique, std::span<const std::uint32_t> modes) {
    const FeatureModes& names = *technique.abilities.feature_modes;
    assert(!modes.empty() && modes.size() <= names.modes.size());
    std::vector<ModeSetting> settings{{std::string(names.count), static_cast<std::uint32_t>(modes.size())}};
    for (std::size_t i = 0; i < modes.size(); ++i) settings.push_back({std::string(names.modes[i]), modes[i]});
    return settings;
}

void use_modes(ChoiceChanges& choices, const Technique& technique, std::span<const std::uint32_t> modes) {
    choices.use(technique);
    for (ModeSetting& setting : settings_of(technique, modes))
        choices.settings.push_back({&technique, std::move(setting.key), double(setting.value)});
}

Result<GatheredFrames> gather_spectra(Session& session, const Technique& technique, const Request& base,
                                      std::span<const std::size_t> frames) {
    GatheredFrames gathered;
    Request request = base;
    request.choices.use(technique);
    request.outputs = {fmt::format("{}:{}", technique.name, technique.abilities.feature_modes->table)};
    request.once = true;
    for (const std::size_t frame : frames) {
        request.variant.frame = frame;
        const auto run = session.run(request);
        if (!run) return run.error();
        const auto skipped = std::ranges::find(run->skipped, technique.stage, &SkippedStage::stage);
        if (skipped != run->skipped.end()) {
            gathered.skipped.push_back(*skipped);
            continue;
        }
        gathered.frames.push_back(spectra_of(run->tables.at(request.outputs.front())));
        gathered.frames.back().frame = frame;
    }
    return gathered;
}

std::vector<std::uint32_t> modes_that_matter(std::span<const FrameSpectra> frames) {
    constexpr std::size_t most = 40, smallest_share = 64;
    const lighting::Histogram tiles = summed(frames);
    const auto is_worth_it = [&](std::uint32_t mode) {
        std::uint64_t served = 0;
        for (const auto& [spectrum, count] : tiles)
            if (lighting::serves(mode, spectrum)) served += count;
        return served * smallest_share >= lighting::tiles_of(tiles);
    };
    const lighting::ModeProblem problem{
        .scenes = scenes_of(frames), .modes = most_settable_modes, .cost = lighting::weighted_cost};
    std::vector<std::uint32_t> modes{problem.full};
    const auto add = [&](std::uint32_t mode) {
        if (modes.size() < most && std::ranges::count(modes, mode) == 0 && is_worth_it(mode)) modes.push_back(mode);
    };
    for (const lighting::Mode& mode : lighting::greedy_modes(problem).modes) add(mode.features);
    for (const std::uint32_t mode : unions_without_a_feature(tiles)) add(mode);
    const lighting::Mode full{problem.full, 0};
    for (const lighting::SpectrumRow& row : lighting::sorted_rows(tiles, std::span(&full, 1))) add(row.spectrum);
    return modes;
}

Result<ModeCosts> weighted_costs(const CostQuestion&) {
    return ModeCosts{.cost = lighting::weighted_cost, .unit = "tiles of a mode without features"};
}

std::span<const CostSource> cost_sources() {
    static constexpr CostSource table[] = {
        {"weights", "1 and an example's weight per feature: takes no time, models no machine", weighted_costs},
        {"measured", "timed here, on the first frame of every capture", measured_costs},
        {"isa", "cycles and waves per SIMD as RADV's compiler states them for --gpu-model", compiled_costs},
    };
    return table;
}

std::optional<double> mean_waves(const SpectraReport& report) {
    if (!report.costs.waves) return {};
    double waves = 0, tiles = 0;
    for (const lighting::SpectrumRow& row : report.rows) {
        waves += double(row.tiles) * report.costs.waves(row.features);
        tiles += double(row.tiles);
    }
    return waves / tiles;
}

namespace {

/// Numbers that are equal where modes leave room for as many waves in both stages.
lighting::ModeWaves waves_of_both_stages(const ModeCosts& costs) {
    if (!costs.waves) return {};
    return [waves = costs.waves, of_taps = costs.tap_waves](std::uint32_t features) {
        constexpr std::uint32_t more_than_waves = 64;
        return more_than_waves * waves(features) + of_taps[(features & feature_gi_tap_visibility) != 0 ? 1 : 0];
    };
}

}  // namespace

SpectraReport find_modes(std::vector<FrameSpectra> frames, ModeCosts costs, const SpectraWish& wish) {
    const lighting::ModeProblem problem{.scenes = scenes_of(frames),
                                        .modes = wish.modes,
                                        .cost = costs.cost,
                                        .dispatch = wish.dispatch,
                                        .aim = wish.aim,
                                        .waves = waves_of_both_stages(costs)};
    SpectraReport report{.wish = wish, .found = lighting::best_modes(problem)};
    const std::vector<lighting::Mode> chosen = as_chosen(report.found.modes);
    report.rows = lighting::sorted_rows(summed(frames), chosen);
    std::vector<std::vector<lighting::SpectrumRow>> rows;
    for (const FrameSpectra& frame : frames) rows.push_back(lighting::sorted_rows(frame.tiles, chosen));
    report.full = lighting::cost_of(problem, {});
    report.as_replayed = cost_as_replayed(frames, costs.cost, wish);
    report.by_modes = cost_of_rows(rows, chosen.size(), costs.cost, wish);
    report.ideal = lighting::ideal_cost(problem);
    report.costs = std::move(costs);
    report.frames = std::move(frames);
    return report;
}

Result<SpectraReport> find_modes(const CostSource& source, CostQuestion question, const SpectraWish& wish) {
    for (;;) {
        auto costs = source.costs(question);
        if (!costs) return costs.error();
        SpectraReport report = find_modes({question.frames.begin(), question.frames.end()}, *std::move(costs), wish);
        const std::vector<std::uint32_t> guessed = guessed_modes(report, question.modes);
        if (guessed.empty()) return report;
        question.modes.insert(question.modes.end(), guessed.begin(), guessed.end());
        question.compiled = report.costs.compiled;
    }
}

}  // namespace strata
