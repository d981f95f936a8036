// What strata bench device counts: bytes that steps declare, operations in their code, and what the device did.
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/scenarios.h"
#include "passes/shader_interop.h"
#include "replay/bench/device_bench.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"
#include "tests/support/test_frame.h"

namespace strata {
namespace {

std::uint64_t bytes_of_step(const TestFrame& frame, std::size_t step, std::optional<std::uint64_t> invocations = {}) {
    const Plan plan = frame.plan();
    return declared_bytes(plan, plan.steps.at(step), invocations);
}

TEST(DeclaredBytes, OfACopyAreReadOnceAndWrittenOnce) {
    TestFrame frame;
    Buffer from = frame.graph.create("from", 1000), to = frame.graph.create("to", 1000);
    frame.graph.clear(from, 1);
    frame.graph.copy(from, to);
    frame.graph.keep(to);
    EXPECT_EQ(bytes_of_step(frame, 0), 1000u) << "a clear writes";
    EXPECT_EQ(bytes_of_step(frame, 1), 2000u);
}

TEST(DeclaredBytes, OfAnImageAreThoseOfThePartThatIsBound) {
    TestFrame frame;
    frame.shader("layer.comp", R"(
        layout(set = 0, binding = 0, rgba16f) writeonly uniform image2DArray target;
        void main() { imageStore(target, ivec3(0), vec4(1)); })");
    Image image = frame.graph.create("image", {.extent = {5, 3}, .format = Format::rgba16f, .layers = 4});
    frame.graph.clear(image, {});
    frame.graph.compute("layer.comp").stores("target", image, {.layer = 2}).groups({});
    frame.graph.keep(image);
    EXPECT_EQ(bytes_of_step(frame, 0), 5u * 3 * 8 * 4);
    EXPECT_EQ(bytes_of_step(frame, 1), 5u * 3 * 8);
}

TEST(DeclaredBytes, OfAPoolThatIsOnlyWrittenAreAtMostOneElementPerInvocation) {
    TestFrame frame;
    frame.shader("once.comp", R"(
        layout(set = 0, binding = 0, scalar) writeonly buffer Pool { uvec2 pool[]; };
        void main() { pool[gl_GlobalInvocationID.x] = uvec2(1); })");
    Buffer pool = frame.graph.create("pool", 8000);
    frame.graph.compute("once.comp").stores("Pool", pool).groups({64, 1, 1});
    frame.graph.keep(pool);
    EXPECT_EQ(bytes_of_step(frame, 0), 8000u) << "nobody counted";
    EXPECT_EQ(bytes_of_step(frame, 0, 64), 64u * 8);
    EXPECT_EQ(bytes_of_step(frame, 0, 4000), 8000u) << "it has no more";
}

TEST(Operations, AreCountedPerComponentAndPerCall) {
    const auto count = [](const char* body, std::uint32_t bits = 0) {
        TestFrame frame;
        frame.shader("counted.comp", fmt::format(R"(
            layout(constant_id = 5) const uint more = 0;
            layout(set = 0, binding = 0, scalar) buffer Values {{ mat3 m; vec3 a, b; float x; uint i; }};
            float twice(float y) {{ return y + y; }}
            void main() {{ {} }})",
                                                 body));
        Buffer values = frame.graph.create("values", 100);
        frame.graph.clear(values, 0);
        frame.graph.compute("counted.comp").updates("Values", values).fixes("more", bits).groups({});
        frame.graph.keep(values);
        return operations_per_invocation(frame.plan().steps.at(1));
    };
    EXPECT_EQ(count("a = b;").operations, 0u) << "a copy";
    EXPECT_EQ(count("a = a * b;").operations, 3u);
    EXPECT_EQ(count("a = fma(a, b, b);").operations, 6u);
    EXPECT_EQ(count("x = dot(a, b);").operations, 5u) << "3 products, 2 sums";
    EXPECT_EQ(count("a = m * b;").operations, 15u) << "9 products, 6 sums";
    EXPECT_EQ(count("m = m * m;").operations, 45u) << "27 products, 18 sums";
    EXPECT_EQ(count("x = sin(x);").operations, 1u);
    EXPECT_EQ(count("x = twice(twice(x));").operations, 2u);
    EXPECT_EQ(count("if (more != 0) x = x + x;", 0).operations, 0u) << "never runs";
    EXPECT_EQ(count("if (more != 0) x = x + x;", 1).operations, 1u);
    const OperationCount looped = count("for (uint k = 0; k < i; ++k) x = x + x;");
    EXPECT_EQ(looped.loops, 1u);
    EXPECT_EQ(looped.operations, 3u) << "one turn: sum, next k, comparison";
}

TEST(DeviceLimits, TwiceTheTurnsAreTwiceTheMultiplyAddsThatTheThreadsCount) {
    const auto measure = [](std::uint32_t iterations) {
        const LimitWork work{.copied_bytes = 4096, .threads = 256, .iterations = iterations, .least_ms = 0};
        return must(measure_limits(shared_device(), 2, work));
    };
    const DeviceLimits once = measure(8), twice = measure(16);
    EXPECT_EQ(once.operations_done, 256u * 8 * 16 * 2) << "16 multiply-adds an iteration, two operations each";
    EXPECT_EQ(twice.operations_done, 2 * once.operations_done);
    EXPECT_EQ(once.copied_bytes, 2u * 4096);
    for (const Spread& spread : {once.bytes, once.operations, twice.operations}) {
        EXPECT_EQ(spread.repeats, 2u);
        EXPECT_TRUE(std::isfinite(spread.median));
        EXPECT_GT(spread.low, 0);
    }
}

TEST(DeviceLimits, GrowUntilCopyAndLoopTakeLongEnough) {
    const LimitWork small{.copied_bytes = 4096, .threads = 64, .iterations = 1, .least_ms = 2};
    const DeviceLimits limits = must(measure_limits(shared_device(), 3, small));
    const auto ms = [](std::uint64_t units, const Spread& per_second) { return 1e3 * double(units) / per_second.low; };
    EXPECT_GT(limits.copied_bytes, 16u * 2 * 4096);
    EXPECT_GT(ms(limits.copied_bytes, limits.bytes), 1);
    EXPECT_GT(limits.threads, 16u * 64);
    EXPECT_GT(ms(limits.operations_done, limits.operations), 1);
    EXPECT_EQ(limits.operations_done, std::uint64_t{limits.threads} * limits.iterations * 16 * 2);
}

TEST(DeviceBench, StoppedGivesTheStepsByTheRunsThatAreComplete) {
    const auto session =
        must(Session::open(std::vector{must(find_scenario("one_pane"))->build(0, {.width = 16, .height = 9})}, {}));
    const Request request;
    std::stop_source stop;
    DeviceBenchWish wish{.request = request, .repeats = 3, .stop = stop.get_token()};
    wish.progress = [&](std::string_view what, double) {
        if (what.starts_with("timing, 3")) stop.request_stop();
    };
    const DeviceBench made = must(bench_device(*session, shared_device(), wish));
    EXPECT_EQ(made.stopped, "stopped after 2 of 3 timed runs");
    ASSERT_FALSE(made.steps.empty());
    EXPECT_EQ(made.steps.front().ms.repeats, 2u);
    const auto none = bench_device(*session, shared_device(), wish);
    ASSERT_THAT(none, FailsWith("session.stopped"));
    EXPECT_EQ(none.error().fault, Fault::stopped);
}

}  // namespace
}  // namespace strata
