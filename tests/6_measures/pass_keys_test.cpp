// What the memo's key of a pass depends on: every setting of every technique, and everything that the pass reads. No device
// needed.
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "passes/graph/graph.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/session/memo.h"

namespace strata {
namespace {

constexpr std::uint64_t frame_key = 1, run_number = 1;

/// The key of a technique's own pass that reads and writes nothing.
std::uint64_t key_of(const Technique& technique, const Settings& settings) {
    PassKeys keys(frame_key, run_number, ShaderLibrary::built_in());
    return keys.key(Graph(), {.technique = &technique, .at = technique.stage}, settings);
}

/// The ends of a parameter's range, its default, and the nearest value to the default that shaders can tell from it.
std::set<double> tried_values(const Param& param) {
    std::set<double> values{param.low, param.fallback};
    for (std::size_t choice = 0; choice < param.choices.size(); ++choice) values.insert(double(choice));
    if (!param.choices.empty()) return values;
    const bool whole = param.scalar == Scalar::integer;
    const auto towards = static_cast<float>(param.fallback < param.high ? param.high : param.low);
    const double next = double(std::nextafter(static_cast<float>(param.fallback), towards));
    values.insert({param.high, whole ? param.fallback + (param.fallback < param.high ? 1 : -1) : next});
    return values;
}

void expect_a_key_per_value(const Technique& technique, const Param& param) {
    std::map<std::uint64_t, double> value_of_key;
    for (const double value : tried_values(param)) {
        Settings settings(technique.params);
        if (!settings.set(param.name, value)) continue;  // rounded out of its range
        const auto [first, is_new] = value_of_key.emplace(key_of(technique, settings), value);
        EXPECT_TRUE(is_new) << fmt::format("{}: {}={} has the key of {}={}", technique.name, param.name, value, param.name,
                                           first->second);
    }
    EXPECT_GE(value_of_key.size(), 2u) << technique.name << ": " << param.name;
}

TEST(PassKeys, DependOnEverySettingOfEveryTechnique) {
    std::size_t params = 0;
    for (const Technique& technique : techniques())
        for (const Param& param : technique.params) {
            expect_a_key_per_value(technique, param);
            ++params;
        }
    EXPECT_GT(params, 50u);
}

TEST(PassKeys, DependOnTheTechniqueTheStageAndTheFrame) {
    std::set<std::uint64_t> keys;
    for (const Technique& technique : techniques()) keys.insert(key_of(technique, Settings(technique.params)));
    EXPECT_EQ(keys.size(), techniques().size());

    const Technique& technique = techniques().front();
    const Settings settings(technique.params);
    const auto key = [&](std::uint64_t frame, Stage at) {
        return PassKeys(frame, run_number, ShaderLibrary::built_in()).key(Graph(), {.technique = &technique, .at = at}, settings);
    };
    EXPECT_EQ(key(1, Stage::culling), key(1, Stage::culling));
    EXPECT_NE(key(1, Stage::culling), key(2, Stage::culling));
    EXPECT_NE(key(1, Stage::culling), key(1, Stage::film));
}

/// What the second of two passes reads of the first.
enum class Reads { image, buffer, nothing };

/// Two passes of one technique: the first writes an image and a buffer.
struct TwoPasses {
    Graph graph;
    Technique technique{.stage = Stage::lighting, .name = "lighting/some", .params = {{.name = "size", .help = "of some"}}};
    const ShaderLibrary* shaders = &ShaderLibrary::built_in();
    std::uint64_t run = run_number;

    explicit TwoPasses(Reads reads) {
        Image image = graph.create("image", {.extent = {8, 8}, .format = Format::r16f});
        Buffer buffer = graph.create("buffer", 64);
        Image result = graph.create("result", {.extent = {8, 8}, .format = Format::r16f});
        graph.enter({});
        graph.compute("first.comp").stores("image", image).stores("Buffer", buffer).over({8, 8});
        graph.enter({});
        ComputeStep second = graph.compute("second.comp").stores("result", result).over({8, 8});
        if (reads == Reads::image) second.loads("image", image);
        if (reads == Reads::buffer) second.loads("Buffer", buffer);
    }

    struct Keys {
        std::uint64_t first, second;
    };
    /// With the first pass's setting at `size`.
    Keys keys(double size) const {
        PassKeys keys(frame_key, run, *shaders);
        Settings settings(technique.params);
        EXPECT_TRUE(settings.set("size", size));
        const std::uint64_t first = keys.key(graph, {.technique = &technique, .at = technique.stage, .scope = 1}, settings);
        return {first, keys.key(graph, {.technique = &technique, .at = Stage::combine, .scope = 2}, Settings(technique.params))};
    }
};

TEST(PassKeys, DependOnTheKeyOfWhateverWroteWhatThePassReads) {
    for (const Reads reads : {Reads::image, Reads::buffer}) {
        const TwoPasses passes(reads);
        EXPECT_EQ(passes.keys(0).second, passes.keys(0).second);
        EXPECT_NE(passes.keys(0).first, passes.keys(1).first);
        EXPECT_NE(passes.keys(0).second, passes.keys(1).second) << "reads " << (reads == Reads::image ? "an image" : "a buffer");
    }
}

TEST(PassKeys, DoNotDependOnWhatThePassDoesNotRead) {
    const TwoPasses passes(Reads::nothing);
    EXPECT_EQ(passes.keys(0).second, passes.keys(1).second);
}

TEST(PassKeys, DependOnTheShadersThatReplaceThoseBuiltIn) {
    ShaderLibrary replaced(&ShaderLibrary::built_in());
    replaced.add({.name = "first.comp", .hash = 5});
    TwoPasses passes(Reads::image);
    const auto before = passes.keys(0);
    passes.shaders = &replaced;
    EXPECT_NE(passes.keys(0).first, before.first);
    EXPECT_NE(passes.keys(0).second, before.second);
}

TEST(PassKeys, OfDrawsDependOnTheVertexShaderThatDrawsTheirList) {
    const auto key = [](bool of_places, const ShaderLibrary& shaders) {
        Graph graph;
        Image color = graph.create("color", {.extent = {8, 8}, .format = Format::rgba16f});
        const Buffer commands = graph.create("commands", 20);
        const Buffer indices = graph.create("indices", 4);
        graph.enter({});
        graph.draw("some/shade", {commands, indices, 0, 1, of_places}).covers(color);
        const Technique technique{.stage = Stage::gbuffer, .name = "gbuffer/some"};
        return PassKeys(frame_key, run_number, shaders)
            .key(graph, {.technique = &technique, .at = Stage::gbuffer, .scope = 1}, {});
    };
    for (const bool of_places : {false, true})
        for (const char* shader : {mesh_vertex_shader, numbered_vertex_shader}) {
            ShaderLibrary replaced(&ShaderLibrary::built_in());
            replaced.add({.name = shader, .hash = 5});
            const bool draws_it = of_places == (shader == std::string_view(numbered_vertex_shader));
            EXPECT_EQ(key(of_places, ShaderLibrary::built_in()) != key(of_places, replaced), draws_it) << shader;
        }
}

TEST(PassKeys, OfPassesThatReadWhatTheLastRunLeftAreNewInEveryRun) {
    Graph graph;
    Buffer left = graph.remember("left", 64);
    graph.enter({});
    graph.compute("some.comp").updates("Left", left).groups({1});
    const Technique technique{.stage = Stage::transparency, .name = "transparency/some"};
    const auto key = [&](std::uint64_t run) {
        PassKeys keys(frame_key, run, ShaderLibrary::built_in());
        return keys.key(graph, {.technique = &technique, .at = technique.stage, .scope = 1}, {});
    };
    EXPECT_NE(key(1), key(2));
    TwoPasses others(Reads::image);
    const auto before = others.keys(0);
    others.run = 2;
    EXPECT_EQ(others.keys(0).second, before.second);
}

}  // namespace
}  // namespace strata
