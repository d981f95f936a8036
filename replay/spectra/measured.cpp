// What a tile costs by the mode that shades it, timed (docs/algorithms/lighting.md 3.5). The technique runs with the full mode
// alone, T(full), and with the full mode and one other, T(m): what is different is what the k tiles save whose spectra m serves,
//     T(full) - T(m) = k (c(full) - c(m)),   c(full) = T(full) / all tiles,   so   c(m) = c(full) - (T(full) - T(m)) / k.
// That takes the saving from the very tiles that m will have, however much heavier others are. Culling is part of T and the same
// for every mode; of the second dispatch the savings pay already. All modes are timed in turn, so that a busy machine cancels.
#include <algorithm>
#include <array>
#include <set>

#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/spectra/spectra.h"

namespace strata {
namespace {

/// Sums over captures.
struct Times {
    double full_ms = 0;
    std::uint64_t tiles = 0;
    std::vector<TimedMode> modes;
};

Request request_with(const CostQuestion& question, std::size_t frame, std::span<const std::uint32_t> modes) {
    Request request = question.base;
    request.variant.frame = frame;
    request.outputs = {std::string(info(question.technique.stage).outputs.front())};
    use_modes(request.choices, question.technique, modes);
    return request;
}

std::uint64_t served_tiles(const FrameSpectra& frame, std::uint32_t mode) {
    std::uint64_t served = 0;
    for (const auto& [spectrum, tiles] : frame.tiles)
        if (lighting::serves(mode, spectrum)) served += tiles;
    return served;
}

/// Median of what the mode's run took less than the full one's, repeat by repeat; noise that says more is no saving.
double saved_ms(const std::vector<double>& full, const std::vector<double>& mode) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < full.size(); ++i) differences.push_back(full[i] - mode[i]);
    return std::max(0., spread_of(differences).median);
}

Result<void> add_times(const CostQuestion& question, const FrameSpectra& frame, Times& times) {
    constexpr std::uint32_t full = every_light_feature;
    std::vector<Request> requests{request_with(question, frame.frame, std::array{full})};
    std::vector<TimedMode*> timed;
    for (TimedMode& mode : times.modes)
        if (served_tiles(frame, mode.features) > 0) {
            requests.push_back(request_with(question, frame.frame, std::array{mode.features, full}));
            timed.push_back(&mode);
        }
    auto session = question.open(frame.capture);
    if (!session) return session.error();
    const auto runs = (*session)->time(requests, question.repeats);
    if (!runs) return runs.error();
    const std::string stage(name(question.technique.stage));
    const std::vector<double>& alone = runs->front().stage_ms_by_repeat.at(stage);
    times.full_ms += spread_of(alone).median;
    times.tiles += lighting::tiles_of(frame.tiles);
    for (std::size_t i = 0; i < timed.size(); ++i) {
        timed[i]->saved_ms += saved_ms(alone, (*runs)[i + 1].stage_ms_by_repeat.at(stage));
        timed[i]->tiles += served_tiles(frame, timed[i]->features);
    }
    return {};
}

}  // namespace

Result<ModeCosts> measured_costs(const CostQuestion& question) {
    Times times;
    for (const std::uint32_t mode : question.modes)
        if (mode != every_light_feature) times.modes.push_back({.features = mode});
    std::set<std::string> done;
    for (std::size_t i = 0; i < question.frames.size(); ++i) {
        const FrameSpectra& frame = question.frames[i];
        if (lighting::tiles_of(frame.tiles) == 0 || !done.insert(frame.capture).second) continue;
        if (question.progress) question.progress("timing " + frame.capture, double(i) / double(question.frames.size()));
        if (const auto added = add_times(question, frame, times); !added) return added.error();
    }
    if (question.progress) question.progress("done", 1);
    const double full = times.full_ms / double(times.tiles);
    std::map<std::uint32_t, double> known{{every_light_feature, full}};
    for (const TimedMode& mode : times.modes)
        if (mode.tiles > 0) known[mode.features] = std::max(0., full - mode.saved_ms / double(mode.tiles));
    return ModeCosts{.cost = lighting::completed_cost(std::move(known)), .unit = "ms", .timed = std::move(times.modes)};
}

}  // namespace strata
