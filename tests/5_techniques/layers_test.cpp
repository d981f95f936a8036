// Every transparency technique on frames of 1 to 300 full-screen cards at shuffled depths, against its model. Sorts and lists
// with bounds known at run time only are where drivers break: lavapipe 22.3 returned a bubble sort unsorted from 8 elements on.
#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <random>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/cards.h"
#include "passes/registry.h"
#include "tests/support/agreement.h"
#include "tests/support/print.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::array layer_counts{1u, 2u, 8u, 31u, 32u, 33u, 64u, 300u};

/// So many cards between 2 and 8 m, submitted in random order: two neighbors are at least 1 cm apart. Coverage falls with their
/// number: 300 layers let 2 % through, and none is so thin that half floats cannot add it.
Frame frame_of_layers(std::uint32_t count) {
    std::mt19937 random(count);
    const auto unit = [&] { return double(random() >> 8) / double(1u << 24); };
    std::vector<Card> cards;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double depth = 2 + 6 * (i + .5 * unit()) / count;
        const auto tint = glm::vec3(glm::dvec3{unit(), unit(), unit()});  // braces: in this order
        cards.push_back(
            {.center = {0, 0, depth}, .color = glm::vec4(tint, float(std::min(1., (.5 + unit()) * 4 / (3 + count))))});
    }
    for (std::size_t i = cards.size(); i > 1; --i) std::swap(cards[i - 1], cards[random() % i]);
    return frame_of_cards(cards, 16);
}

/// A session of their own, which ends with them: the pipelines of all variants take much of the host's memory on a CPU driver.
class ShuffledLayers : public testing::TestWithParam<Technique> {
protected:
    static void SetUpTestSuite() {
        std::vector<Frame> frames;
        for (const std::uint32_t count : layer_counts) frames.push_back(frame_of_layers(count));
        session_ = session_of(std::move(frames));
    }
    static void TearDownTestSuite() { session_.reset(); }

    static inline std::unique_ptr<Session> session_;
};

/// The settings of a point, "key=value key=value", apart.
std::vector<std::string> lines_of(std::string_view point) {
    std::istringstream words{std::string(point)};
    return {std::istream_iterator<std::string>(words), {}};
}

/// At each of the points: settings as "key=value key=value".
void expect_layers_as_modeled(Session& session, const Technique& technique, std::span<const std::string_view> points) {
    for (std::size_t frame = 0; frame < layer_counts.size(); ++frame)  // outside: a session has one frame loaded
        for (const std::string_view point : points) {
            SCOPED_TRACE(fmt::format("{} layers, {}", layer_counts[frame], point));
            const Request request{.variant = {.frame = frame}, .choices = chosen({std::string(technique.name)}, lines_of(point))};
            const Accuracy accuracy = must(session.judge(request, Stage::transparency, Against::model));
            if (!accuracy.not_supported.empty()) continue;
            expect_within_tolerance(accuracy, technique, request);
            EXPECT_GT(accuracy.compared, 0u) << "all undecided";
        }
}

TEST_P(ShuffledLayers, AreWhatTheModelSaysAtEveryNumberOfThem) {
    expect_layers_as_modeled(*session_, GetParam(), std::array{std::string_view()});
}

using ExhaustiveShuffledLayers = ShuffledLayers;

TEST_P(ExhaustiveShuffledLayers, AreWhatTheModelSaysAtEverySettingOfTheReport) {
    expect_layers_as_modeled(*session_, GetParam(), GetParam().variants);
}

std::vector<Technique> of_the_stage() {
    std::vector<Technique> found;
    for (const Technique* technique : techniques_of(Stage::transparency)) found.push_back(*technique);
    return found;
}

INSTANTIATE_TEST_SUITE_P(Techniques, ShuffledLayers, testing::ValuesIn(of_the_stage()), technique_test_name);
INSTANTIATE_TEST_SUITE_P(Techniques, ExhaustiveShuffledLayers, testing::ValuesIn(of_the_stage()), technique_test_name);

}  // namespace
}  // namespace strata
