// Every view of every technique is drawn, at one sample and at four.
#include <cmath>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

class Views : public testing::TestWithParam<std::string_view> {};

/// 80 pixels across: nothing here depends on how many there are.
Request small_smoke(std::uint32_t samples) {
    Request request = on_scenario("smoke_grenade", samples);
    request.variant.extent_divisor *= 2;
    return request;
}

TEST_P(Views, AreDrawnAndFinite) {
    const Technique& technique = *must(find_technique(GetParam()));
    for (const std::uint32_t samples : {1u, 4u})
        for (const DebugView& view : technique.views) {
            Request request = small_smoke(samples);
            request.choices = chosen({std::string(technique.name)});
            request.outputs = {fmt::format("{}:{}", technique.name, view.name)};
            const auto run = must(session_of_scenarios().run(request));
            const ReferenceImage picture = in_double(run.images.at(request.outputs[0]));
            ASSERT_EQ(picture.width, run.width);
            for (const glm::dvec4& texel : picture.texels)
                ASSERT_TRUE(std::isfinite(texel.x) && std::isfinite(texel.y) && std::isfinite(texel.z)) << view.name;
        }
}

TEST_P(Views, AndTablesHaveRowsOfNumbers) {
    const Technique& technique = *must(find_technique(GetParam()));
    for (const DebugTable& table : technique.tables) {
        Request request = small_smoke(1);
        request.choices = chosen({std::string(technique.name)});
        request.outputs = {fmt::format("{}:{}", technique.name, table.name)};
        const auto numbers = must(session_of_scenarios().run(request)).tables.at(request.outputs[0]);
        EXPECT_EQ(numbers.columns.size(), table.columns.size());
        EXPECT_FALSE(numbers.rows.empty()) << table.name;
        for (const std::vector<double>& row : numbers.rows) {
            ASSERT_EQ(row.size(), table.columns.size());
            for (const double number : row) ASSERT_TRUE(std::isfinite(number)) << table.name;
        }
    }
}

std::vector<std::string_view> with_views() {
    std::vector<std::string_view> names;
    for (const Technique& technique : techniques())
        if (!technique.views.empty()) names.push_back(technique.name);
    return names;
}

std::string viewed_technique_name(const testing::TestParamInfo<std::string_view>& info) {
    std::string name(info.param);
    name[name.find('/')] = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(Techniques, Views, testing::ValuesIn(with_views()), viewed_technique_name);

}  // namespace
}  // namespace strata
