// Shaders changed while the program runs: what changed is compiled and executed again, what is wrong is said with its place, and
// until it is right the last good ones stay.
#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/graph/shader_sources.h"
#include "replay/glsl/compile_glsl.h"
#include "replay/images/image_io.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"
#include "tests/support/shader_folder.h"

namespace strata {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// The last shader of a frame: it makes the picture and nothing else.
const std::string film = "combine/hi_lo/film.comp", film_source = "passes/combine/hi_lo/film.comp";

void darken(const ShaderFolder& folder) { folder.change(film_source, "sum / float(samples)", "sum * 0.5 / float(samples)"); }

TEST(ShaderSources, AreWhatTheShadersBuiltInWereCompiledFromAndHow) {
    const std::vector<std::string> some{film, "transparency/weighted/accumulate.frag", "gbuffer/octahedral/fill.frag"};
    const auto codes = must(compile_glsl(GlslSources::built_in(), some, {}));
    for (std::size_t i = 0; i < some.size(); ++i)
        EXPECT_TRUE(std::ranges::equal(codes[i], ShaderLibrary::built_in().find(some[i])->code)) << some[i];
}

TEST(ShaderSources, HoldEveryShaderAndAllThatOneIncludes) {
    std::vector<std::string_view> known;
    for (const ShaderSource& source : shader_sources()) known.push_back(source.name);
    for (const std::string& shader : ShaderLibrary::built_in().names())
        EXPECT_EQ(std::ranges::count(known, source_name(shader)), 1) << shader;
    for (const auto& [name, text] : shader_sources())
        for (std::size_t at = text.find("#include \"passes/"); at != text.npos; at = text.find("#include \"passes/", at + 1))
            EXPECT_EQ(std::ranges::count(known, text.substr(at + 10, text.find('"', at + 10) - at - 10)), 1) << name;
}

TEST(ReloadedShaders, ChangeThePictureAndGivenBackGiveItBackBitByBit) {
    const ShaderFolder folder;
    const auto session = scenario_session("three_panes");
    const auto before = must(session->run({})).images.at("display");
    darken(folder);
    const auto reloaded = must(session->reload_shaders(folder.path()));
    EXPECT_THAT(reloaded.replaced, ElementsAre(film));
    EXPECT_EQ(reloaded.compiled, 1u);
    const auto dark = must(session->run({}));
    for (std::uint32_t y = 0; y < 36; y += 5)
        EXPECT_NEAR(texel(dark.images.at("display"), 32, y).y, texel(before, 32, y).y / 2, 1e-3);
    EXPECT_THAT(dark.notes, ElementsAre(HasSubstr("1 shader replaced")));
    folder.restore(film_source);
    EXPECT_THAT(must(session->reload_shaders(folder.path())).replaced, IsEmpty());
    EXPECT_EQ(display_hash(*session), hash_of(before));
}

TEST(ReloadedShaders, HaveOnlyWhatDependsOnThemCompiledAndExecutedAgain) {
    const ShaderFolder folder;
    // On a device of its own, which has no pipelines of other tests.
    const auto session = must(Session::open(scenario_frames("three_panes"), {.validation = true}));
    must(session->run({}));
    darken(folder);
    must(session->reload_shaders(folder.path()));
    const auto run = must(session->run({}));
    EXPECT_EQ(run.passes_executed, 1u);
    EXPECT_EQ(run.pipelines_created, 1u);
    const auto again = must(session->reload_shaders(folder.path()));
    EXPECT_THAT(again.replaced, ElementsAre(film));
    EXPECT_EQ(again.compiled, 0u);
}

TEST(ReloadedShaders, FindNothingThatOthersLeftToTheNextFrame) {
    const ShaderFolder folder;
    const auto session = scenario_session("two_rooms");
    const auto indirect = [&](const std::string& relight) {
        const Request request{.choices = chosen({"indirect/lpv"}, {"map_size=16", "iterations=2", relight}),
                              .outputs = {"indirect"}};
        return hash_of(must(session->run(request)).images.at("indirect"));
    };
    const auto before = indirect("relight=changed");
    folder.change("passes/indirect/lpv/injection/resolve.comp", "1.0 / push.fixed_one", "0.5 / push.fixed_one");
    must(session->reload_shaders(folder.path()));
    const auto after = indirect("relight=changed");
    EXPECT_NE(after, before);
    EXPECT_EQ(after, indirect("relight=always"));
}

TEST(ReloadedShaders, ThatAreWrongAreSaidWithTheirPlaceAndTheLastGoodOnesStay) {
    const ShaderFolder folder;
    const auto session = scenario_session("three_panes");
    darken(folder);
    must(session->reload_shaders(folder.path()));
    const std::string dark = display_hash(*session);
    const auto file = folder.change(film_source, "0.5", "nothing_known");
    const auto refused = session->reload_shaders(folder.path());
    const std::string place =
        fmt::format("{}:{}: 'nothing_known'", file.string(), line_of(folder.text(film_source), "nothing_known"));
    ASSERT_THAT(refused, FailsWith("glsl.not_compiled", Field("messages", HasSubstr(place))));
    EXPECT_EQ(refused.error().fault, Fault::bad_input);
    EXPECT_EQ(display_hash(*session), dark);
    session->forget_memo();
    EXPECT_EQ(display_hash(*session), dark);
}

TEST(ReloadedShaders, SayAWrongIncludeOnceForAllThatIncludeIt) {
    const ShaderFolder folder;
    const auto session = scenario_session("three_panes");
    const std::string name = "passes/gbuffer/fill.glsl";
    const auto file = folder.write(name, folder.text(name) + "\nint broken = not_known;\n");
    const auto refused = session->reload_shaders(folder.path());
    const std::string place = fmt::format("{}:{}: 'not_known'", file.string(), line_of(folder.text(name), "int broken"));
    ASSERT_THAT(refused, FailsWith("glsl.not_compiled", Field("messages", HasSubstr(place)), Field("shaders", HasSubstr(", "))));
    const std::string& sentence = refused.error().sentence;
    EXPECT_EQ(sentence.find(place), sentence.rfind(place)) << sentence;
}

TEST(ReloadedShaders, WhoseInterfaceNoLongerFitsAreRefusedInTheGraphsWords) {
    const ShaderFolder folder;
    const auto session = scenario_session("three_panes");
    const std::string before = display_hash(*session);
    folder.change(film_source, "sampler2DArray color", "sampler2DArray colors");
    folder.change(film_source, "(color, ", "(colors, ");
    const Request shown;
    const auto refused = session->reload_shaders(folder.path(), std::span(&shown, 1));
    ASSERT_THAT(refused, FailsWith("graph.unknown_binding", Field("shader", film), Field("binding", "color"),
                                   Field("suggestion", HasSubstr("colors"))));
    EXPECT_EQ(display_hash(*session), before);
    // Who shows nothing is told when running.
    must(session->reload_shaders(folder.path()));
    const auto run = session->run(shown);
    ASSERT_FALSE(run);
    EXPECT_EQ(run.error().sentence, refused.error().sentence);
    folder.restore(film_source);
    must(session->reload_shaders(folder.path()));
    EXPECT_EQ(display_hash(*session), before);
}

TEST(ReloadedShaders, ThatCppReadsAsWellNeedABuild) {
    const ShaderFolder folder;
    const auto session = scenario_session("three_panes");
    const std::string name = "passes/shaders/scene.shared.h";
    folder.write(name, folder.text(name) + "// more\n");
    EXPECT_THAT(session->reload_shaders(folder.path()), FailsWith("glsl.shared_header_differs", Field("file", HasSubstr(name))));
}

// As a GPU could do it, whose two vertex shaders need not put a vertex at the same place.
TEST(ReloadedShaders, ThatStoreFragmentsWhichWereNotCountedFailTheReplay) {
    const ShaderFolder folder;
    const auto session = scenario_session("glass_and_smoke");
    const Request request{.choices = chosen({"transparency/sorted_lists"})};
    folder.change("passes/transparency/lists/count.frag", "if (!in_band(pixel.y))",
                  "if (!in_band(pixel.y) || pixel.x % 2u == 0u)");
    must(session->reload_shaders(folder.path()));
    EXPECT_THAT(session->run(request), FailsWith("technique.fatal_counter", Field("counter", "miscounted")));
}

TEST(ReloadedShaders, WhoseSwapsAreNotDoneFailTheReplay) {
    struct Swapping {
        std::string technique, setting, shader, bound;
    };
    for (const Swapping& swapping :
         {Swapping{"transparency/a_buffer", "layers=9", "passes/transparency/a_buffer/store.frag", "4u * most_counted + 1u"},
          Swapping{"transparency/voxel", "splat=saturating", "passes/transparency/voxel/volume/splat.frag", "1u << 17u"}}) {
        const ShaderFolder folder;
        const auto session = scenario_session("three_panes");
        const Request request{.choices = chosen({swapping.technique}, {swapping.setting})};
        must(session->run(request));
        folder.change(swapping.shader, "most_swaps = " + swapping.bound, "most_swaps = 0u");
        must(session->reload_shaders(folder.path()));
        EXPECT_THAT(session->run(request), FailsWith("technique.fatal_counter", Field("counter", "unfinished")))
            << swapping.technique;
    }
}

TEST(ReloadedShaders, OfAFolderWithoutShadersAreASentence) {
    const ShaderFolder folder;
    const auto session = scenario_session("three_panes");
    EXPECT_THAT(session->reload_shaders(folder.path()), FailsWith("glsl.cannot_read_folder"));
    std::filesystem::create_directories(folder.path() / "passes");
    EXPECT_THAT(session->reload_shaders(folder.path()), FailsWith("glsl.no_shaders", Field("folder", folder.path().string())));
}

TEST(ReloadedShaders, WithoutTheCompilerSayWhatToInstall) {
    const ShaderFolder folder;
    const auto session = scenario_session("three_panes");
    darken(folder);
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nonexistent", 1);
    const auto refused = session->reload_shaders(folder.path());
    setenv("PATH", path.c_str(), 1);
    ASSERT_THAT(refused, FailsWith("glsl.no_compiler"));
    EXPECT_THAT(refused.error().sentence, HasSubstr("glslang-tools"));
    EXPECT_THAT(must(session->reload_shaders(folder.path())).replaced, Not(IsEmpty()));
}

}  // namespace
}  // namespace strata
