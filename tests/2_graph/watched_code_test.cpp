// Every shader of ours can be watched: what it does stays the same to reflection, but for two bindings more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/graph/shader.h"
#include "passes/graph/watch/mark_regions.h"
#include "passes/graph/watch/watched_code.h"

namespace strata {
namespace {

Watched everything(const Shader& shader) {
    Watched watched{.bindings = {}, .slots = {2, 0, 1}};
    for (const ShaderBinding& binding : shader.bindings)
        if (binding.kind != BindingKind::uniform_buffer)
            watched.bindings.push_back({binding.set, binding.binding, binding.read, binding.written});
    if (shader.stage == ShaderStage::fragment) watched.attachments.assign(shader.color_outputs, 1);
    return watched;
}

TEST(WatchedCode, IsMadeOfEveryBuiltInShader) {
    const ShaderLibrary& library = ShaderLibrary::built_in();
    std::size_t grown = 0;
    for (const std::string& name : library.names()) {
        const Shader& shader = *library.find(name);
        const auto code = watched_code(shader.code, everything(shader));
        ASSERT_TRUE(code) << name << ": " << code.error().sentence;
        const auto again = reflect(name, *code);
        ASSERT_TRUE(again) << again.error().sentence;
        grown += code->size() > shader.code.size();
        EXPECT_EQ(again->constants.size(), shader.constants.size()) << name;
        EXPECT_EQ(again->push_bytes, shader.push_bytes) << name;
        for (const ShaderBinding& binding : shader.bindings)
            EXPECT_EQ(std::ranges::count(again->bindings, binding.name, &ShaderBinding::name), 1) << name << ' ' << binding.name;
    }
    EXPECT_GT(grown, 200u);
}

TEST(WatchedCode, IsTheSameWhereNothingIsWatched) {
    const ShaderLibrary& library = ShaderLibrary::built_in();
    const Shader& shader = *library.find("combine/hi_lo/combine.comp");
    const auto code = watched_code(shader.code, {.bindings = {{7, 7, true, true}}, .slots = {2, 0, 1}});
    ASSERT_TRUE(code);
    EXPECT_TRUE(std::ranges::equal(*code, shader.code));
}

TEST(UnitBits, CountWhatBoxesAndWordsHold) {
    const Shape shape{.extent = {37, 5}, .layers = 3, .samples = 4};
    const std::uint64_t units = 37 * 5 * 3 * 4;
    UnitBits bits(units);
    bits.add(shape, {.first_column = 30, .columns = 100, .first_row = 1, .rows = 2, .first_layer = 2, .layers = 9});
    EXPECT_EQ(bits.count(), 7u * 2 * 4);
    bits.add(shape, {.first_column = 30, .columns = 3, .first_row = 2, .rows = 1, .first_layer = 2, .layers = 1});
    EXPECT_EQ(bits.count(), 7u * 2 * 4);
    bits.add(shape, {.first_column = 40, .columns = 3, .rows = 5, .layers = 3});
    EXPECT_EQ(bits.count(), 7u * 2 * 4);
    std::vector<std::uint32_t> marks(units / 32 + 1, ~0u);
    MarkRegion region{.units = units, .is_marked = true};
    EXPECT_EQ(used_units(region, shape, marks).count(), units);  // the bit behind the last is no unit
    UnitBits all(units);
    all.add_all();
    EXPECT_EQ(all.count(), units);
    all.keep_only(bits);
    EXPECT_EQ(all.count(), 7u * 2 * 4);
}

}  // namespace
}  // namespace strata
