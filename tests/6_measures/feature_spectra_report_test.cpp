// What is gathered of captures, timed and told about feature spectra, with a session that answers by formula instead of a device.
#include <algorithm>
#include <array>
#include <numeric>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "passes/technique.h"
#include "replay/spectra/spectra.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr std::uint32_t blockers_portals = feature_blockers | feature_portals;
constexpr std::uint32_t soft_spot = feature_blockers | feature_shadows | feature_soft_shadows | feature_square_spot;
const lighting::Histogram example = {{0, 1716}, {blockers_portals, 2917}, {soft_spot, 2154}};

const Technique& some_technique() {
    static constexpr std::array<std::string_view, 16> modes = {"mode_0", "mode_1", "mode_2", "mode_3"};
    static const Technique technique{
        .stage = Stage::lighting,
        .name = "lighting/some",
        .tables = {{.name = "spectra", .columns = {{"spectrum", ""}, {"tiles", ""}, {"mode", ""}, {"superfluous", ""}}}},
        .abilities = {.feature_modes =
                          FeatureModes{.table = "spectra", .constant = "mode_features", .count = "modes", .modes = modes}}};
    return technique;
}

std::uint32_t value_of(const Request& request, const std::string& setting) {
    for (const SettingChange& change : request.choices.settings)
        if (change.technique && change.technique->name == "lighting/some" && change.key == setting)
            return std::uint32_t(std::get<double>(change.value));
    return 0;
}

/// A capture of two frames, the second without lights; heavy tiles take three times as long whatever shades them, and every turn
/// of a timing is on a busier machine than the one before.
class FormulaSession : public Session {
public:
    const DeviceInfo& device() const override { return device_; }
    const Capture* capture() const override { return nullptr; }
    std::size_t frame_count() const override { return 2; }
    Result<Frame> frame(std::size_t) override { return Frame{}; }
    Result<strata::Run> run(const Request& request) override {
        strata::Run run;
        if (request.variant.frame == 1) {
            run.skipped.push_back({Stage::lighting, "the frame has no lights"});
            return run;
        }
        NumberTable table{.columns = some_technique().tables.front().columns};
        for (const auto& [spectrum, tiles] : example)
            table.rows.push_back({double(spectrum), double(tiles), 0, double(every_light_feature & ~spectrum)});
        run.tables.emplace(request.outputs.front(), table);
        return run;
    }
    Result<std::vector<strata::Run>> time(std::span<const Request> requests, std::size_t repeats, const Progress&) override {
        std::vector<strata::Run> runs(requests.size());
        for (std::size_t i = 0; i < requests.size(); ++i)
            for (std::size_t turn = 0; turn < repeats; ++turn)
                runs[i].stage_ms_by_repeat["lighting"].push_back(milliseconds(requests[i]) + 100 * (double(turn) - 1));
        return runs;
    }
    Result<strata::Run> run_from(const Request&, Stage, const ImageSet&) override { return not_asked(); }
    Result<PlannedFrame> plan(const Request&) override { return not_asked(); }
    Result<HostImage> peek(const Request&, std::size_t, const std::string&) override { return not_asked(); }
    Result<std::vector<StepImages>> step_images(const Request&, Stage) override { return not_asked(); }
    Result<std::vector<StepImages>> pixel_steps(const Request&, glm::uvec2) override { return not_asked(); }
    Result<std::vector<Cover>> draw_cover(const Request&, std::uint32_t) override { return not_asked(); }
    Result<ImageSet> stage_images(const Request&, Stage) override { return not_asked(); }
    Result<ImageSet> truth(const Request&, Stage) override { return not_asked(); }
    Result<Accuracy> judge(const Request&, Stage, Against, const ImageSet*) override { return not_asked(); }
    Result<const FragmentLists*> transparent_fragments(const Request&) override { return not_asked(); }
    Result<std::vector<strata::Run>> run(Frame, std::span<const Request>) override { return not_asked(); }
    Result<ReloadedShaders> reload_shaders(const std::filesystem::path&, std::span<const Request>) override {
        return not_asked();
    }
    void stop_when(std::stop_token) override {}
    void forget_memo() override {}

    /// Of all tiles by the request's modes: what a mode costs, and 2 ms more for each of the heavy tiles.
    static double milliseconds(const Request& request) {
        std::vector<lighting::Mode> modes;
        for (std::uint32_t i = 0; i < value_of(request, "modes"); ++i) {
            const std::uint32_t features = value_of(request, fmt::format("mode_{}", i));
            modes.push_back({features, lighting::weighted_cost(features)});
        }
        double sum = 5;  // culling
        for (const auto& [spectrum, tiles] : example)
            sum += double(tiles) * (modes[lighting::choose(modes, spectrum)].cost + (spectrum == soft_spot ? 2 : 0));
        return sum;
    }

private:
    static Error not_asked() { return fail(Fault::usage, "test.not_asked", "a formula has no such thing"); }
    DeviceInfo device_;
};

std::vector<FrameSpectra> gathered() {
    FormulaSession session;
    const auto made = gather_spectra(session, some_technique(), {}, std::array<std::size_t, 2>{0, 1});
    EXPECT_TRUE(made);
    EXPECT_EQ(made->skipped.size(), 1u);
    return made->frames;
}

CostQuestion question(const Technique& technique, const std::vector<FrameSpectra>& frames) {
    return {.technique = technique,
            .base = {},
            .frames = frames,
            .modes = modes_that_matter(frames),
            .open = [](const std::string&) -> Result<std::unique_ptr<Session>> {
                return std::unique_ptr<Session>(std::make_unique<FormulaSession>());
            },
            .repeats = 3};
}

TEST(SpectraGathered, AreTheRowsOfTheTableOfFramesThatAreLit) {
    const std::vector<FrameSpectra> frames = gathered();
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].frame, 0u);
    EXPECT_EQ(frames[0].tiles, example);
    for (const lighting::SpectrumRow& row : frames[0].rows) EXPECT_EQ(row.features, every_light_feature);
}

TEST(ModesThatMatter, AreTheFullOneThoseGreedyTakesAndFrequentSpectra) {
    std::vector<FrameSpectra> frames = gathered();
    const std::vector<std::uint32_t> modes = modes_that_matter(frames);
    for (const auto& [spectrum, tiles] : example) EXPECT_EQ(std::ranges::count(modes, spectrum), 1) << spectrum;
    EXPECT_EQ(std::ranges::count(modes, std::uint32_t(every_light_feature)), 1);
    frames[0].tiles = {{blockers_portals, 2917}, {feature_hair, 3}};
    EXPECT_EQ(std::ranges::count(modes_that_matter(frames), std::uint32_t(feature_hair)), 0) << "it serves 3 tiles of 2920";
}

TEST(MeasuredCosts, AreTheSavingsOfTheTilesThatAModeServesHoweverHeavyOthersAre) {
    const Technique& technique = some_technique();
    const std::vector<FrameSpectra> frames = gathered();
    const auto costs = measured_costs(question(technique, frames));
    ASSERT_TRUE(costs);
    EXPECT_EQ(costs->unit, "ms");
    const double full = costs->cost(every_light_feature);
    // 5 ms of culling and 2 ms of each heavy tile are everyone's: not a mode's.
    const double shared = (5 + 2 * 2154.) / double(lighting::tiles_of(example));
    EXPECT_NEAR(full, lighting::weighted_cost(every_light_feature) + shared, 1e-9);
    for (const auto& [spectrum, tiles] : example)
        EXPECT_NEAR(costs->cost(spectrum), lighting::weighted_cost(spectrum) + shared, 1e-9) << spectrum;
    // So the modes are those of the true costs, and the prediction is the time with them.
    const SpectraReport report = find_modes(frames, *costs, {.modes = 4});
    EXPECT_EQ(report.found.modes.size(), 4u);
    Request request;
    std::vector<std::uint32_t> modes;
    for (const lighting::Mode& mode : report.found.modes) modes.push_back(mode.features);
    use_modes(request.choices, technique, modes);
    EXPECT_NEAR(report.by_modes, FormulaSession::milliseconds(request), 1e-6);
    request.choices = {};
    use_modes(request.choices, technique, std::array{every_light_feature});
    EXPECT_NEAR(report.full, FormulaSession::milliseconds(request), 1e-6);
    EXPECT_NEAR(report.as_replayed, report.full, 1e-6);
}

TEST(MeasuredCosts, OfACaptureThatDoesNotOpenAreItsError) {
    const Technique& technique = some_technique();
    const std::vector<FrameSpectra> frames = gathered();
    CostQuestion asked = question(technique, frames);
    asked.open = [](const std::string&) -> Result<std::unique_ptr<Session>> {
        return fail(Fault::bad_input, "test.is_gone", "it is gone");
    };
    EXPECT_THAT(measured_costs(asked), FailsWith("test.is_gone"));
}

/// Cycles by the weights, of those modes alone that are asked for, as a compiler would say; and no mode twice.
Result<ModeCosts> asked_of_a_compiler(const CostQuestion& asked) {
    std::map<std::uint32_t, lighting::CompiledMode> compiled = asked.compiled;
    for (const std::uint32_t mode : asked.modes) compiled[mode] = {.cycles = 100 * lighting::weighted_cost(mode), .waves = 4};
    EXPECT_EQ(compiled.size(), asked.modes.size());
    return ModeCosts{.cost = lighting::compiled_cost(compiled), .unit = "cycles", .compiled = compiled};
}

TEST(CompiledCosts, AreThoseOfTheModesThatAreFoundHoweverFewWereKnownAtFirst) {
    const Technique& technique = some_technique();
    const std::vector<FrameSpectra> frames = gathered();
    CostQuestion asked = question(technique, frames);
    asked.modes = {every_light_feature, 0};
    const auto report = find_modes({"isa", "", asked_of_a_compiler}, asked, {.modes = 4});
    ASSERT_TRUE(report);
    EXPECT_EQ(report->found.modes.size(), 4u);
    for (const lighting::Mode& mode : report->found.modes) {
        EXPECT_TRUE(report->costs.compiled.contains(mode.features)) << mode.features;
        EXPECT_NEAR(mode.cost, 100 * lighting::weighted_cost(mode.features), 1e-9) << mode.features;
    }
}

TEST(ModesThatMatter, TellADearFeatureFromTheRest) {
    FrameSpectra frame;
    for (std::uint32_t bit = 0; bit < 8; ++bit) frame.tiles[1u << bit] = 10;
    const std::vector<std::uint32_t> modes = modes_that_matter(std::array{frame});
    for (std::uint32_t bit = 0; bit < 8; ++bit) EXPECT_EQ(std::ranges::count(modes, 0xffu & ~(1u << bit)), 1) << bit;
}

TEST(Predictions, AreOfTheModesThatTilesChooseByTheirWeightsWhateverCostsFoundThem) {
    constexpr std::uint32_t portals = blockers_portals, shadows = feature_blockers | feature_shadows;
    FrameSpectra frame;
    frame.tiles = {{feature_blockers, 10}, {portals, 1000}, {shadows, 1000}};
    // By weights portals cost less than shadows, by these costs more.
    const lighting::ModeCost cost = lighting::completed_cost({{portals, 4}, {shadows, 2}, {every_light_feature, 9}});
    const SpectraReport report = find_modes({frame}, {.cost = cost, .unit = "ms"}, {.modes = 3});
    ASSERT_EQ(report.found.modes.size(), 3u);
    EXPECT_EQ(report.found.cost, 10 * 2 + 1000 * 4 + 1000 * 2);
    EXPECT_EQ(report.by_modes, 10 * 4 + 1000 * 4 + 1000 * 2);
}

TEST(SpectraText, ListsModesPredictionsTheReadoutAndALineToPaste) {
    SpectraReport report = find_modes(gathered(), {.cost = lighting::weighted_cost, .unit = "tiles"}, {.modes = 3});
    report.technique = &some_technique();
    report.cost_source = "weights";
    const std::string text = as_text(report);
    EXPECT_THAT(text, AllOf(HasSubstr("lighting/some: 1 frame of 1 capture, 6787 tiles with something to light, 3 spectra"),
                            HasSubstr("mode  2  0xffff"), HasSubstr("{Blockers, Portals}"), HasSubstr("one full mode"),
                            HasSubstr("3 modes, proven the best"), HasSubstr("superfluous: Blockers in 1716, Portals in 1716"),
                            HasSubstr("(1) 2917 tiles {Blockers, Portals}, shading mode 0, superfluous {}\n"),
                            HasSubstr("(3) 1716 tiles <Nothin' Special>, shading mode 0, superfluous {Blockers, Portals}\n"),
                            HasSubstr("--use lighting/some --set modes=3 --set mode_0=3 --set mode_1=29 --set mode_2=65535\n")));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("(")) {
            EXPECT_LE(line.size(), 120u) << line;
        }
    SpectraReport of_one = find_modes(gathered(), report.costs, {.modes = 1});
    of_one.technique = &some_technique();
    EXPECT_THAT(as_text(of_one), Not(HasSubstr("1 modes")));
}

TEST(SpectraJson, HoldsTheSameAndTheFramesOneByOne) {
    SpectraReport report = find_modes(gathered(), {.cost = lighting::weighted_cost, .unit = "tiles"}, {.modes = 3});
    report.technique = &some_technique();
    const json made = json::parse(as_json(report));
    EXPECT_EQ(made["schema"], "strata.spectra");
    EXPECT_EQ(made["schema_version"], 1);
    EXPECT_EQ(made["modes"].size(), 3u);
    EXPECT_EQ(made["modes"][0]["features"], json({"Blockers", "Portals"}));
    EXPECT_EQ(made["modes"][0]["tiles"], 2917 + 1716);
    EXPECT_EQ(made["settings"], json({"modes=3", "mode_0=3", "mode_1=29", "mode_2=65535"}));
    EXPECT_LT(made["predicted"]["modes"], made["predicted"]["as_replayed"]);
    EXPECT_LE(made["predicted"]["ideal"], made["predicted"]["modes"]);
    EXPECT_EQ(made["predicted"]["full"], made["predicted"]["as_replayed"]);
    EXPECT_EQ(made["frames"][0]["spectra"].size(), 3u);
    EXPECT_EQ(made["spectra"][2]["superfluous"], json({"Blockers", "Portals"}));
    EXPECT_FALSE(made.contains("timed"));
    const Technique& technique = some_technique();
    const std::vector<FrameSpectra> frames = gathered();
    SpectraReport by_time = find_modes(frames, *measured_costs(question(technique, frames)), {.modes = 3});
    by_time.technique = &technique;
    const json timed = json::parse(as_json(by_time));
    EXPECT_GE(timed["timed"].size(), 3u);
    EXPECT_GT(timed["timed"][0]["saved_ms"], 0);
}

TEST(CostSources, HaveNamesOfTheirOwn) {
    for (const CostSource& source : cost_sources())
        EXPECT_EQ(std::ranges::count(cost_sources(), source.name, &CostSource::name), 1) << source.name;
}

}  // namespace
}  // namespace strata
