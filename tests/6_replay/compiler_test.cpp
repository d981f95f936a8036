// RADV compiling for GPUs that are not there, in a process of its own: its stated occupancy against the rule we take it to
// follow.
#include <unistd.h>

#include <cstdlib>

#include <gtest/gtest.h>

#include "passes/shader_interop.h"
#include "replay/isa/compile_elsewhere.h"
#include "replay/isa/occupancy.h"
#include "tests/support/glsl.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr const char* shared_words = R"(
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint words = 4;
layout(set = 0, binding = 0) buffer Values { uint values[]; };
shared uint held[words];
void main() {
    held[gl_LocalInvocationIndex * 7u % words] = values[gl_GlobalInvocationID.x];
    barrier();
    values[gl_GlobalInvocationID.x] = held[(gl_LocalInvocationIndex * 3u + values[0]) % words];
})";

PipelineRequest request_of(const Shader& shader, std::uint32_t threads, std::uint32_t bytes) {
    PipelineRequest request{.label = fmt::format("{} threads with {} bytes", threads, bytes)};
    request.step.step = {.name = shader.name, .shaders = {shader.name}};
    request.step.step.fixed = {{shader.group_constants[0], threads}, {"words", bytes / 4}};
    request.step.shaders = {&shader};
    for (const ShaderBinding& binding : shader.bindings)
        request.step.bindings.push_back({.set = binding.set, .slot = binding.binding, .kind = binding.kind});
    return request;
}

/// What the compiler states against its rule, and ours never above it; what differs goes to stderr. Returns how much that is.
int differences(const GpuModel& model) {
    const Shader shader = glsl("shared.comp", shared_words);
    std::vector<PipelineRequest> requests;
    for (const std::uint32_t threads : {32u, 64u, 128u, 192u, 256u, 512u, 1024u})
        for (const std::uint32_t bytes : {256u, 2048u, 4352u, 6144u, 12288u, 16384u, 16640u, 32768u, 49152u, 65536u})
            requests.push_back(request_of(shader, threads, bytes));
    const Compilation made = must(compile_here(requests, 0, CompilerTexts::left));
    int wrong = 0;
    for (std::size_t i = 0; i < requests.size(); ++i) {
        const Executable& program = made.pipelines.at(i).executables.at(0);
        const auto number = [&](std::string_view name) { return static_cast<std::uint32_t>(program.statistic({name}).value()); };
        const Extent group = group_size(requests[i].step);
        const ShaderResources taken{.registers = number("VGPRs"),
                                    .scalar_registers = number("SGPRs"),
                                    .lds_bytes = number("LDS size"),
                                    .group_threads = group.width,
                                    .wave_lanes = program.wave_lanes};
        const std::uint32_t stated = number("Subgroups per SIMD"), rule = stated_by_radv(model, taken);
        const double ours = occupancy(model, taken).waves_per_simd * program.wave_lanes / model.unit->lanes;
        if (stated == rule && ours <= stated) continue;
        fmt::print(stderr, "{}: stated {}, by its rule {}, ours {}\n", requests[i].label, stated, rule, ours);
        ++wrong;
    }
    return wrong;
}

/// In a process that has nothing to lose: RADV aborts for families it does not know. Never returns.
[[noreturn]] void compile_for(const GpuModel& model) {
    const std::string drivers = must(find_radv(environ));
    for (const char* list : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) setenv(list, drivers.c_str(), 1);
    setenv("RADV_FORCE_FAMILY", std::string(model.family).c_str(), 1);
    const int wrong = differences(model);
    fmt::print(stderr, "compared\n");
    _exit(wrong == 0 ? 0 : 1);  // leaving the usual way waits for the driver's threads
}

TEST(Compiler, StatesTheWavesOfEveryGroupByTheRuleWeKnowAndNeverFewerThanFit) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    for (const char* family : {"bonaire", "polaris10", "vega10", "navi10", "navi21"}) {
        const GpuModel& model = *must(find_gpu_model(family));
        EXPECT_EXIT(compile_for(model), testing::ExitedWithCode(0), "compared") << family;
    }
}

}  // namespace
}  // namespace strata
