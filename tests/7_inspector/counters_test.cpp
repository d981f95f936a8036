// What was counted, beside what was counted before.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"
#include "ui/frame/counter_rows.h"

namespace strata::ui {
namespace {

/// Two techniques of one stage with a counter of the same name.
struct Pair {
    const Technique* one = nullptr;
    const Technique* other = nullptr;
    std::string name;
};
Pair techniques_that_count_alike() {
    for (const Technique& one : techniques())
        for (const Technique& other : techniques())
            if (&one != &other && one.stage == other.stage && !one.counters.empty() && !other.counters.empty() &&
                one.counters.front().name == other.counters.front().name)
                return {&one, &other, std::string(one.counters.front().name)};
    throw std::runtime_error("no two techniques count alike");
}

TEST(CounterRows, ACounterStandsBesideTheOneOfTheSameNameOfTheTechniqueItReplaced) {
    const Pair pair = techniques_that_count_alike();
    const std::vector<CounterRecord> before = {{std::string(pair.one->name), pair.name, 200}},
                                     now = {{std::string(pair.other->name), pair.name, 250}};
    const auto rows = counter_rows(now, before);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].technique, pair.other->name);
    EXPECT_EQ(rows[0].now, 250u);
    EXPECT_EQ(rows[0].before, 200u);
    EXPECT_EQ(change_text(rows[0]), "+50 (+25 %)");
    EXPECT_EQ(rows[0].help, pair.other->counters.front().help);
    EXPECT_EQ(counter_rows({}, before)[0].now, std::nullopt);
}

TEST(CounterRows, LongNumbersAreGrouped) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1 000");
    EXPECT_EQ(grouped(1234567), "1 234 567");
}

TEST(CountersPanel, SaysWhatTheReplayCountedAndWhatItCountedBeforeAChange) {
    Desk& desk = Desk::clean();
    desk.model().select_frame(frame_of("glass_and_smoke"));
    must(desk.player->click("tabs/Counters"));
    must(desk.player->wait());
    const auto first = desk.replay();
    ASSERT_FALSE(first->run.counters.empty());
    for (const CounterRecord& record : first->run.counters)
        EXPECT_EQ(desk.said(fmt::format("Counters/{}/{}/now", record.technique, record.name)), grouped(record.value));
    const Choice& recorded = desk.model().choices().at(Stage::transparency);
    const auto counts_otherwise = [&](const Technique* other) {
        return other != recorded.technique && !other->counters.empty() && other->needs.empty();
    };
    const auto others = techniques_of(Stage::transparency);
    const auto other = std::ranges::find_if(others, counts_otherwise);
    ASSERT_NE(other, others.end());
    desk.model().use(**other);
    must(desk.player->wait());
    EXPECT_THAT(desk.said("Counters/before"), testing::HasSubstr(first->run.choices.at("transparency")));
    EXPECT_LE(desk.widget("Counters/before").to.x, desk.widget("Image/picture").to.x) << "nothing of it is cut off";
    must(desk.player->choose("Counters/against", "as recorded"));
    must(desk.player->wait());
    for (const CounterRecord& record : desk.replay()->run.counters) {
        const auto was = std::ranges::find_if(first->run.counters, [&](const CounterRecord& each) {
            return each.technique == record.technique && each.name == record.name;
        });
        if (was == first->run.counters.end()) continue;
        EXPECT_EQ(desk.said(fmt::format("Counters/{}/{}/before", record.technique, record.name)), grouped(was->value));
    }
    desk.expect_no_conflicts();
    must(desk.player->choose("Counters/against", "before the last change"));
}

}  // namespace
}  // namespace strata::ui
