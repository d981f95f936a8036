// What a driver is given of a shader: the functions that its specialization constants let run.
#include <algorithm>
#include <cstring>
#include <set>
#include <string_view>

#include <gtest/gtest.h>

#include "passes/graph/reached_code.h"
#include "passes/graph/shader.h"

namespace strata {
namespace {

using Code = std::vector<std::uint32_t>;

// SPIR-V 1.6, 3.49.9
constexpr std::uint32_t op_function = 54, op_function_call = 57;

/// Calls visit(opcode, words) for every instruction.
template <typename Visit>
void for_each_instruction(std::span<const std::uint32_t> code, const Visit& visit) {
    for (std::size_t at = 5; at < code.size(); at += code[at] >> 16) visit(code[at] & 0xffffu, code.subspan(at, code[at] >> 16));
}

std::size_t function_count(std::span<const std::uint32_t> code) {
    std::size_t count = 0;
    for_each_instruction(code, [&](std::uint32_t op, auto) { count += op == op_function; });
    return count;
}

/// Functions that are called and not there.
std::size_t missing_functions(std::span<const std::uint32_t> code) {
    std::set<std::uint32_t> there, called;
    for_each_instruction(code, [&](std::uint32_t op, auto words) {
        if (op == op_function) there.insert(words[2]);
        if (op == op_function_call) called.insert(words[3]);
    });
    std::erase_if(called, [&](std::uint32_t id) { return there.contains(id); });
    return called.size();
}

const Shader& shader(std::string_view name) { return *ShaderLibrary::built_in().find(name); }

Code with(const Shader& shader, std::string_view constant, std::uint32_t bits) {
    const auto found = std::ranges::find(shader.constants, constant, &ShaderConstant::name);
    EXPECT_NE(found, shader.constants.end()) << constant;
    const ConstantBits given{found->id, bits};
    return reached_code(shader.code, std::span(&given, 1));
}

TEST(ReachedCode, LightsAreLeftOutWhereNothingIsLit) {
    const Shader& draw = shader("transparency/weighted/accumulate.frag");
    const Code lit = with(draw, "used_models", ~0u), unlit = with(draw, "used_models", 1);
    EXPECT_EQ(lit, reached_code(draw.code, {})) << "all is what the shader says";
    EXPECT_LT(2 * function_count(unlit), function_count(lit));
    EXPECT_LT(unlit.size(), lit.size() * 2 / 3);
}

TEST(ReachedCode, OutputMasksOfSamplesGoWithTheFunctionThatWritesThem) {
    const Shader& fill = shader("gbuffer/octahedral/fill.frag");
    constexpr std::uint32_t op_decorate = 71, builtin = 11, sample_mask = 20;  // SPIR-V 1.6, 3.20, 3.21 and 3.49.3
    const auto masks = [&](std::uint32_t technique) {
        std::vector<ConstantBits> given;
        for (const ShaderConstant& constant : fill.constants) {
            if (constant.name == "masked") given.push_back({constant.id, technique});
            if (constant.name == "mask_samples") given.push_back({constant.id, 4});
        }
        std::size_t count = 0;
        for_each_instruction(reached_code(fill.code, given), [&](std::uint32_t op, auto words) {
            count += op == op_decorate && words[2] == builtin && words[3] == sample_mask;
        });
        return count;
    };
    EXPECT_EQ(masks(0), 0u) << "an output that nothing writes is undefined";
    EXPECT_EQ(masks(1), 1u);
}

TEST(ReachedCode, VolumesAreLeftOutWhereThereAreNone) {
    const Shader& draw = shader("transparency/weighted/accumulate.frag");
    const Code without = with(draw, "light_grids", 0), with_one = with(draw, "light_grids", 1);
    EXPECT_EQ(without, reached_code(draw.code, {}));
    // Those of passes/indirect/volume_light.glsl and of what it includes, and the two of fragment.glsl that call them.
    EXPECT_LE(function_count(without) + 18, function_count(with_one));
}

TEST(ReachedCode, EveryShaderStaysWhole) {
    for (const EmbeddedShader& embedded : embedded_shaders()) {
        const Result<Shader> whole = reflect(std::string(embedded.name), embedded.code);
        ASSERT_TRUE(whole);
        std::vector<ConstantBits> zeros;
        for (const ShaderConstant& constant : whole->constants) zeros.push_back({constant.id, 0});
        for (const std::vector<ConstantBits>& given : {std::vector<ConstantBits>{}, zeros}) {
            const Code reached = reached_code(embedded.code, given);
            EXPECT_EQ(missing_functions(reached), 0u) << embedded.name;
            EXPECT_LE(reached.size(), embedded.code.size()) << embedded.name;
            EXPECT_EQ(reached_code(reached, given), reached) << embedded.name << ": nothing is left to leave out";
            const Result<Shader> again = reflect(std::string(embedded.name), reached);
            ASSERT_TRUE(again) << embedded.name << ": " << again.error().sentence;
            EXPECT_EQ(again->constants.size(), whole->constants.size()) << embedded.name;
        }
    }
}

}  // namespace
}  // namespace strata
