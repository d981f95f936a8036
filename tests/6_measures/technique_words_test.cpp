// What a user may write for a technique: its name, its name without the stage, or what the field calls it.
#include <array>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/choice_text.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string_view name_called(std::string_view word, std::optional<Stage> stage = std::nullopt) {
    const auto found = technique_called(word, stage);
    return found ? (*found)->name : std::string_view("none");
}

TEST(TechniqueWords, AreTheNamesOfTheField) {
    const std::pair<std::string_view, std::string_view> known[] = {
        {"wboit", "transparency/weighted"}, {"mboit", "transparency/moments"},     {"mlab", "transparency/multi_layer"},
        {"avboit", "transparency/voxel"},   {"ppll", "transparency/sorted_lists"}, {"ssao", "occlusion/ssao"}};
    for (const auto& [word, technique] : known) EXPECT_EQ(name_called(word), technique) << word;
    EXPECT_EQ(find_stage("oit"), Stage::transparency);
    EXPECT_EQ(find_stage("gi"), Stage::indirect);
}

TEST(TechniqueWords, FindTheTechniqueInEveryOption) {
    std::size_t aliases = 0;
    for (const Technique& technique : techniques())
        for (const std::string_view alias : technique.aliases) {
            ++aliases;
            const auto used = parse_choices(std::array{std::string(alias)}, {});
            ASSERT_TRUE(used) << used.error().sentence;
            EXPECT_EQ(used->technique(technique.stage), &technique) << alias;
            const std::string_view key = technique.params.empty() ? "" : technique.params.front().name;
            const auto set = parse_choices({}, std::array{fmt::format("{}:{}=1", alias, key)});
            ASSERT_TRUE(set) << set.error().sentence;
            EXPECT_EQ(set->settings.front().technique, &technique) << alias;
            const auto variant = parse_variant(technique.stage, alias);
            ASSERT_TRUE(variant) << variant.error().sentence;
            EXPECT_EQ(variant->technique, &technique) << alias;
            for (const std::string_view stage : info(technique.stage).aliases)
                EXPECT_EQ(name_called(fmt::format("{}/{}", stage, alias)), technique.name);
        }
    EXPECT_GE(aliases, 4u);
}

TEST(TechniqueWords, MeanOneThingEach) {
    std::set<std::string_view> words;
    for (const StageInfo& stage : stages()) {
        EXPECT_TRUE(words.insert(stage.name).second) << stage.name;
        for (const std::string_view alias : stage.aliases) EXPECT_TRUE(words.insert(alias).second) << alias;
    }
    std::set<std::string_view> short_names;  // two stages may have a technique "none"
    for (const Technique& technique : techniques()) short_names.insert(short_name(technique));
    for (const std::string_view word : short_names) EXPECT_TRUE(words.insert(word).second) << word;
    for (const Technique& technique : techniques())
        for (const std::string_view alias : technique.aliases) EXPECT_TRUE(words.insert(alias).second) << alias;
}

TEST(TechniqueWords, ThatSeveralStagesHaveAreAskedBack) {
    EXPECT_THAT(technique_called("none"),
                FailsWith("technique.ambiguous", Field("technique", "none"), Field("stages", 2),
                          Field("known", AllOf(HasSubstr("culling/none"), HasSubstr("occlusion/none")))));
    EXPECT_EQ(name_called("none", Stage::occlusion), "occlusion/none");
    EXPECT_THAT(parse_variant(Stage::transparency, "tiled"),
                FailsWith("technique.of_another_stage", Field("stage", "lighting"), Field("wanted", "transparency")));
}

TEST(TechniqueWords, OfAStageAreAnsweredWithItsTechniques) {
    for (const std::string_view word : {"oit", "transparency"})
        EXPECT_THAT(technique_called(word), FailsWith("technique.is_a_stage", Field("stage", "transparency"),
                                                      Field("known", HasSubstr("transparency/weighted"))));
    EXPECT_THAT(technique_called("gi"), FailsWith("technique.is_a_stage", Field("known", "indirect/lpv or indirect/ambient")));
}

TEST(TechniqueWords, MisspelledAreAnsweredWithTheNearest) {
    EXPECT_THAT(technique_called("wboti"), FailsWith("technique.unknown", Field("suggestion", HasSubstr("wboit"))));
    EXPECT_THAT(technique_called("weigthed"), FailsWith("technique.unknown", Field("suggestion", HasSubstr("weighted"))));
    EXPECT_THAT(technique_called("transparency/weigthed"),
                FailsWith("technique.unknown", Field("suggestion", HasSubstr("transparency/weighted"))));
    EXPECT_THAT(technique_called("tield", Stage::transparency), FailsWith("technique.unknown", Field("suggestion", "")));
}

}  // namespace
}  // namespace strata
