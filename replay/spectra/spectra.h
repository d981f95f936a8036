// The feature spectra of captures and the shading modes that serve them best (docs/algorithms/lighting.md 3.4 to 3.7).
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "passes/lighting/mode_costs.h"
#include "passes/lighting/mode_search.h"
#include "replay/isa/compiled_pipeline.h"
#include "replay/isa/gpu_models.h"
#include "replay/isa/pipeline_request.h"
#include "replay/report/report.h"
#include "replay/session/session.h"
#include "replay/tables/sheet.h"

namespace strata {

/// The technique with FeatureModes: the one chosen for the stage, which must have them, else the first on the list that has.
Result<const Technique*> technique_of_spectra(const ChoiceChanges&);

/// A parameter of such a technique.
struct ModeSetting {
    std::string key;
    std::uint32_t value = 0;
    std::string text() const { return fmt::format("{}={}", key, value); }
};
/// The parameters that make the technique shade with these modes.
std::vector<ModeSetting> settings_of(const Technique&, std::span<const std::uint32_t> modes);
/// Chooses the technique, with these modes.
void use_modes(ChoiceChanges&, const Technique&, std::span<const std::uint32_t> modes);
inline constexpr std::size_t most_settable_modes = 16;

/// The tiles of a frame that something is shaded in.
struct FrameSpectra {
    std::string capture;
    std::size_t frame = 0;
    lighting::Histogram tiles;
    std::vector<lighting::SpectrumRow> rows;  ///< with the modes that it was replayed with
};
struct GatheredFrames {
    std::vector<FrameSpectra> frames;
    std::vector<SkippedStage> skipped;  ///< of frames without the stage
};
Result<GatheredFrames> gather_spectra(Session&, const Technique&, const Request& base, std::span<const std::size_t> frames);

/// A mode beside the full one on the first frame of every capture, timed against the full one alone.
struct TimedMode {
    std::uint32_t features = 0;
    std::uint64_t tiles = 0;  ///< that it served
    double saved_ms = 0;      ///< on them
};

/// What modes cost.
struct ModeCosts {
    lighting::ModeCost cost;
    lighting::ModeWaves waves = {};  ///< empty: not known
    /// Waves per SIMD of the steps of another stage that read light volumes, without and with tap visibility; 0: none does.
    std::array<std::uint32_t, 2> tap_waves = {};
    std::string unit;  ///< of a tile's cost
    std::vector<TimedMode> timed = {};
    std::map<std::uint32_t, lighting::CompiledMode> compiled = {};  ///< by features
};
/// What whoever prices modes may look at.
struct CostQuestion {
    const Technique& technique;
    Request base;
    std::span<const FrameSpectra> frames;
    std::vector<std::uint32_t> modes;  ///< that matter most, and the full one; the cost of others is to be completed from these
    std::function<Result<std::unique_ptr<Session>>(const std::string& capture)> open;
    std::size_t repeats = 7;
    Progress progress = {};
    const GpuModel* gpu = nullptr;  ///< that `compile` compiles for
    std::function<Result<Compilation>(const std::vector<PipelineRequest>&)> compile = {};
    std::map<std::uint32_t, lighting::CompiledMode> compiled = {};  ///< what it need not be asked again
};
/// A way to price modes: `--cost NAME`.
struct CostSource {
    std::string_view name, help;
    Result<ModeCosts> (*costs)(const CostQuestion&);
};
std::span<const CostSource> cost_sources();
Result<ModeCosts> weighted_costs(const CostQuestion&);
/// Times the technique on the first frame of every capture, see measured.cpp.
Result<ModeCosts> measured_costs(const CostQuestion&);
/// By the compiler of a GPU, see compiled.cpp.
Result<ModeCosts> compiled_costs(const CostQuestion&);
/// At most 40 modes that are worth asking for: those a greedy search by weights takes, for every feature the union of the spectra
/// that do without it, then the most frequent spectra; each serves at least one tile in 64, fewer drown in a timer's noise.
std::vector<std::uint32_t> modes_that_matter(std::span<const FrameSpectra>);

struct SpectraWish {
    std::size_t modes = 8;  ///< at most, the full one included
    lighting::Aim aim = lighting::Aim::sum;
    double dispatch = 0;  ///< in the unit of costs
};
struct SpectraReport {
    const Technique* technique = nullptr;
    std::string cost_source = {};
    SpectraWish wish = {};
    ModeCosts costs = {};
    std::vector<FrameSpectra> frames = {};
    lighting::ModeSet found = {};
    std::vector<lighting::SpectrumRow> rows = {};               ///< of all frames, with the modes that were found
    double full = 0, as_replayed = 0, by_modes = 0, ideal = 0;  ///< predicted costs of all frames, by the wish's aim
    std::string date = {};                                      ///< utc_date(); the caller's
};
/// Waves per SIMD, the mean over the tiles as the modes that were found shade them; nothing where costs know no waves.
std::optional<double> mean_waves(const SpectraReport&);
SpectraReport find_modes(std::vector<FrameSpectra>, ModeCosts, const SpectraWish&);

/// The same of the question's frames by what the source says of modes. Where that is a compiler, modes that are found and were
/// not compiled are, and the search begins anew: no mode is found by a guess.
Result<SpectraReport> find_modes(const CostSource&, CostQuestion, const SpectraWish&);

std::string as_text(const SpectraReport&);
std::string as_json(const SpectraReport&);
/// A row for each mode that was found.
Sheet sheet_of(const SpectraReport&);
/// The modes and the spectra as one table.
std::string as_csv(const SpectraReport&);
/// The text, then the modes as a table.
Page page_of(const SpectraReport&);

}  // namespace strata
