#include "tests/support/agreement.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "replay/session/choice_text.h"

namespace strata {
namespace {

/// Texels that are not background which a comparison must have. What is culled has one texel per draw.
std::size_t least_nontrivial(Stage stage) { return stage == Stage::culling ? 1 : 16; }
}  // namespace

void expect_within_tolerance(const Accuracy& accuracy, const Technique& technique, const Request& request,
                             std::string_view scenario) {
    ASSERT_EQ(accuracy.incomparable, "") << technique.name << " on " << scenario;
    const std::string sets = fmt::format("{}", fmt::join(set_texts(request.choices), " "));
    // Written into --gtest_output=json: what tolerances are set by.
    testing::Test::RecordProperty(fmt::format("rmse {}", sets), fmt::format("{:.3g}", accuracy.model_rmse));
    testing::Test::RecordProperty(fmt::format("worst {}", sets), fmt::format("{:.3g}", accuracy.model_worst));
    testing::Test::RecordProperty(fmt::format("texels {}", sets), fmt::format("{} - {}", accuracy.compared, accuracy.trivial));
    const WorstTexel& w = accuracy.worst;
    const View view = must(session_of_scenarios().frame(request.frame)).view;
    const std::string where = fmt::format(
        "{}: worst at ({}, {}) layer {} of {}: got {:.9g} {:.9g} {:.9g}, the model says {:.9g} {:.9g} {:.9g}\n"
        "reproduce: strata record {} --size {}x{} --samples {} && strata report {}.strata --stage {} {}",
        technique.name, w.x, w.y, w.layer, w.image, w.got.x, w.got.y, w.got.z, w.wanted.x, w.wanted.y, w.wanted.z, scenario,
        view.width / request.extent_divisor, view.height / request.extent_divisor, request.samples, scenario,
        name(technique.stage), sets.empty() ? "" : "--set " + sets);
    const Tolerance tolerance = tolerance_at(technique.tolerance, sets, scenario);
    EXPECT_LE(accuracy.model_rmse, tolerance.rmse) << where;
    EXPECT_LE(accuracy.model_worst, tolerance.worst) << where;

    // Two black images agree about nothing; and a model that cannot decide much proves little.
    EXPECT_GE(accuracy.compared - accuracy.trivial, least_nontrivial(technique.stage)) << where;
    EXPECT_LT(double(accuracy.undecided), .25 * double(accuracy.compared + accuracy.undecided)) << where;
}

}  // namespace strata
