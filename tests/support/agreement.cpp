#include "tests/support/agreement.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/choice_text.h"
#include "tests/support/shell_lines.h"

namespace strata {
namespace {

/// Texels that are not background which a comparison must have. What is culled has one texel per draw. Indirect light that must
/// be exact is none at all: every texel is black, and any other value is an error.
std::size_t least_nontrivial(const Technique& technique) {
    if (technique.stage == Stage::indirect && technique.tolerance.worst == 0) return 0;
    return technique.stage == Stage::culling ? 1 : 16;
}

std::string sets_of(const Request& request) { return fmt::format("{}", fmt::join(set_texts(request.choices), " ")); }

}  // namespace

void expect_within_tolerance(const Accuracy& accuracy, const Technique& technique, const Request& request,
                             std::string_view scenario) {
    const std::string sets = sets_of(request);
    const std::string judged =
        fmt::format("{} {} on {} at {}", technique.name, sets,
                    scenario.empty() ? fmt::format("frame {}", request.variant.frame) : scenario, request.variant.samples);
    ASSERT_EQ(accuracy.incomparable, "") << judged;
    testing::Test::RecordProperty(judged, fmt::format("rmse {:.3g} worst {:.3g} of {} - {} texels", accuracy.model_rmse,
                                                      accuracy.model_worst, accuracy.compared, accuracy.trivial));
    const WorstTexel& w = accuracy.worst;
    const std::string where = fmt::format(
        "{}: worst at ({}, {}) layer {} of {}: got {:.9g} {:.9g} {:.9g} {:.9g}, the model says {:.9g} {:.9g} {:.9g} {:.9g}",
        judged, w.x, w.y, w.layer, w.image, w.got.x, w.got.y, w.got.z, w.got.w, w.wanted.x, w.wanted.y, w.wanted.z, w.wanted.w);
    const Tolerance tolerance = tolerance_at(technique.tolerance, sets, scenario);
    EXPECT_LE(accuracy.model_rmse, tolerance.rmse) << where;
    EXPECT_LE(accuracy.model_worst, tolerance.worst) << where;
}

void expect_proven_within_tolerance(const Accuracy& accuracy, const Technique& technique, const Request& request,
                                    std::string_view scenario) {
    SCOPED_TRACE("reproduce: " + line_that_judges(technique, request, scenario));
    expect_within_tolerance(accuracy, technique, request, scenario);
    // Two black images agree about nothing; and a model that cannot decide much proves little.
    EXPECT_GE(accuracy.compared - accuracy.trivial, least_nontrivial(technique));
    EXPECT_LT(double(accuracy.undecided), .25 * double(accuracy.compared + accuracy.undecided));
}

}  // namespace strata
