// What the device is given and what judges it are derived apart: a draw missing from a list that both read is missing from the
// picture, the model and the truth at once, and no comparison shows it. passes/scene/ derives what the device is given from the
// recorded frame, passes/reference/ what models, truths and judges start from.
#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"

namespace strata {
namespace {

struct Exception {
    std::string_view path, because;
};

/// Headers of passes/reference/ that anybody may include.
constexpr std::array plain_values = {
    Exception{"passes/reference/image.h", "texels in double with their extent: nothing in it is derived from a frame"},
    Exception{"passes/reference/standard_error.h", "two numbers that say how exact a truth is, for reports"},
    Exception{"passes/reference/ltc_table.h", "constants fitted once (fit_ltc), uploaded as they are"},
};

/// Files that models, truths and judges share, beside those whose names say it. A name without a suffix stands for .h and .cpp.
constexpr std::array parts_of_references = {
    Exception{"passes/combine/formulas", "the stage's formulas in double"},
    Exception{"passes/culling/view_planes", "the planes of the view in double"},
    Exception{"passes/gbuffer/codes", "the codes of a G-buffer in double"},
    Exception{"passes/gbuffer/coverage/bands", "how alpha becomes a pattern of samples, in double"},
    Exception{"passes/gbuffer/coverage/mask_tests", "which samples masked surfaces cover, in double"},
    Exception{"passes/gbuffer/nearest", "the nearest surfaces in double"},
    Exception{"passes/indirect/direct_light", "light that arrives at a ray's hit, in double"},
    Exception{"passes/indirect/leg_blockers", "blockers between two surfaces, in double"},
    Exception{"passes/indirect/volume_light", "light of volumes at any place, in double"},
    Exception{"passes/lighting/every_light", "lighting in double"},
    Exception{"passes/rain/formulas", "wet surfaces in double"},
    Exception{"passes/shadows/kernel", "filter kernels in double"},
    Exception{"passes/shadows/lookup", "lookups of shadow maps in double"},
    Exception{"passes/shadows/receivers", "the points that visibility is asked for, in double"},
    Exception{"passes/sun_shafts/shadow_intervals", "shadow along rays, in double"},
    Exception{"passes/transparency/sample_blend", "blending in double"},
};

/// Files that show a reference to the user, or keep it between models. None of them feeds the device.
constexpr std::array shows_references = {
    Exception{"replay/deep/deep_image", "writes the reference's fragments as deep EXR"},
    Exception{"replay/session/device_session.h", "keeps the fragments that models and the truth start from"},
    Exception{"replay/images/draw_cover", "shows which pixels a draw covers"},
    Exception{"replay/session/drawn_by", "names the draw of a reference's fragment"},
    Exception{"replay/images/host_image.h", "a device's image in double, to compare"},
    Exception{"replay/probe/probe", "measures functions of a pixel's fragments"},
    Exception{"replay/probe/probe_frame", "measures functions of a pixel's fragments"},
    Exception{"ui/pixel/pixel_fragments", "shows a pixel's fragments"},
    Exception{"replay/probe/pixel_in_frame", "compares the pixel as a display shows it"},
    Exception{"replay/report/compare_with_truth", "compares images with the truth of their stage"},
    Exception{"replay/report/pictures", "shows the radiance of the truth and of rows as a display does"},
    Exception{"replay/report/picture_error", "compares the displayed picture with that of the truth"},
    Exception{"replay/session/step_counts", "counts fragments in double, where a device's count is wrong"},
    Exception{"replay/session/judgment", "leaves out samples whose coverage hangs on the steps of the device"},
};

/// Parts of references that ask the scene. This list only gets shorter.
constexpr std::array asks_the_scene = {
    Exception{"passes/lighting/tiled/cull_scene", "a mirror of culling reads the records that the device culls"},
    Exception{"passes/shadows/lookup", "where shadow maps lie: a model of lookups reads the maps that the device drew"},
};

bool is_listed(std::span<const Exception> list, const std::string& path) {
    const std::string stem = path.substr(0, path.rfind('.'));
    return std::ranges::any_of(list, [&](const Exception& one) { return one.path == path || one.path == stem; });
}

bool is_of_references(const std::string& path) {
    const std::string stem = std::filesystem::path(path).stem().string();
    const bool is_named = stem == "model" || stem == "truth" || stem == "judge" || stem.ends_with("_model");
    return (is_named && path.starts_with("passes/")) || path.starts_with("passes/reference/") ||
           is_listed(parts_of_references, path);
}

/// Calls visit(path, line number, included path) for every #include outside of tests of a file in a folder of passes/.
template <typename Visit>
void for_every_include_of(const std::string& folder, const Visit& visit) {
    for (const SourceFile& file : source_files()) {
        const std::string path = file.path.generic_string();
        if (file.folder() == "tests" || path.ends_with("_test.cpp")) continue;
        for (std::size_t line = 0; line < file.lines.size(); ++line)
            if (const std::string to = included(file.lines[line]); to.starts_with(folder)) visit(path, line + 1, to);
    }
}

TEST(Derivations, NothingThatFeedsTheDeviceIncludesAReference) {
    for_every_include_of("passes/reference/", [](const std::string& from, std::size_t line, const std::string& to) {
        const bool may = is_of_references(from) || is_listed(plain_values, to) || is_listed(shows_references, from);
        EXPECT_TRUE(may) << from << ":" << line << " includes " << to << ": derive it in passes/scene/";
    });
}

TEST(Derivations, NoReferenceIncludesTheScene) {
    for_every_include_of("passes/scene/", [](const std::string& from, std::size_t line, const std::string& to) {
        const bool may = !is_of_references(from) || is_listed(asks_the_scene, from);
        EXPECT_TRUE(may) << from << ":" << line << " includes " << to << ": derive it from the recorded frame";
    });
}

TEST(Derivations, TheListsOfExceptionsHoldNothingThatIsSeparated) {
    std::set<std::string> of_references, of_scene;
    const auto remember = [](std::set<std::string>& files) {
        return [&files](const std::string& from, std::size_t, const std::string&) {
            files.insert(from);
            files.insert(from.substr(0, from.rfind('.')));
        };
    };
    for_every_include_of("passes/reference/", remember(of_references));
    for_every_include_of("passes/scene/", remember(of_scene));
    for (const auto list : {std::span<const Exception>(parts_of_references), std::span<const Exception>(shows_references)})
        for (const Exception& one : list)
            EXPECT_TRUE(of_references.contains(std::string(one.path))) << one.path << " includes no reference: take it off";
    for (const Exception& one : asks_the_scene)
        EXPECT_TRUE(of_scene.contains(std::string(one.path))) << one.path << " does not include the scene: take it off";
}

}  // namespace
}  // namespace strata
