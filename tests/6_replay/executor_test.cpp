// What the executor makes of a plan: clears, dispatches, copies, peeks, times. Raster steps are in executor_raster_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "passes/frame_images.h"
#include "tests/support/test_frame.h"

namespace strata {

void PrintTo(const FormatRow& format, std::ostream* out) { *out << format.name; }

namespace {

using testing::Each;
using testing::ElementsAre;
using testing::Gt;
using testing::SizeIs;

constexpr ImportId scratch_id{0x7e57};

class EveryFormat : public testing::TestWithParam<FormatRow> {};

TEST_P(EveryFormat, IsClearedAndReadBack) {
    TestFrame frame;
    const double one = GetParam().kind == FormatKind::integer ? 7 : 0.5;
    Image image = frame.graph.create("cleared", {.extent = {5, 3}, .format = GetParam().format});
    frame.graph.clear(image, {{one, 1, 0, 1}});
    const HostImage result = frame.result(image);
    ASSERT_EQ(result.texels.size(), 15 * GetParam().bytes);
    const glm::dvec4 all_channels(one, 1, 0, 1);
    for (std::uint32_t i = 0; i < GetParam().channels; ++i) {
        const auto channel = static_cast<glm::length_t>(i);
        EXPECT_NEAR(texel(result, 4, 2)[channel], all_channels[channel], 0.003) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Formats, EveryFormat, testing::ValuesIn(format_rows),
                         [](const auto& format) { return std::string(format.param.name); });

TEST(Executor, DispatchesOneThreadPerTexel) {
    TestFrame frame;
    frame.shader("fill.comp", R"(
        layout(local_size_x = 8, local_size_y = 8) in;
        layout(set = 0, binding = 0, rg32f) writeonly uniform image2DArray target;
        void main() {
            const ivec3 at = ivec3(gl_GlobalInvocationID);
            if (all(lessThan(at, imageSize(target)))) imageStore(target, at, vec4(at.x + 100 * at.y, at.z, 0, 0));
        })");
    Image image = frame.graph.create("filled", {.extent = {21, 9}, .format = Format::rg32f, .layers = 4});
    frame.graph.compute("fill.comp").stores("target", image).over({21, 9, 4});
    const HostImage result = frame.result(image);
    EXPECT_EQ(texel(result, 20, 8, 3), glm::dvec4(820, 3, 0, 1));
    EXPECT_EQ(texel(result, 0, 0, 0), glm::dvec4(0, 0, 0, 1));
}

TEST(Executor, HandsConstantsAndPushedValuesToTheShader) {
    TestFrame frame;
    frame.shader("values.comp", R"(
        layout(constant_id = 3) const uint fixed_word = 1;
        layout(constant_id = 4) const float fixed_real = 1;
        layout(push_constant, scalar) uniform Push { float pushed; uint count; };
        layout(set = 0, binding = 1, scalar) writeonly buffer Values { float values[]; };
        void main() { values[0] = float(fixed_word); values[1] = fixed_real; values[2] = pushed; values[3] = float(count); })");
    struct Push {
        float pushed;
        std::uint32_t count;
    };
    Buffer values = frame.graph.create("values", 16);
    frame.graph.compute("values.comp")
        .stores("Values", values)
        .fixes("fixed_word", 17u)
        .fixes("fixed_real", 2.5f)
        .push(Push{0.25f, 9})
        .groups({});
    frame.graph.keep(values);
    EXPECT_THAT(values_of<float>(frame.run().buffers.at(values.id)), ElementsAre(17, 2.5f, 0.25f, 9));
}

TEST(Executor, MakesOnePipelinePerSetOfConstantsAndKeepsThem) {
    TestFrame frame;
    frame.shader("constant.comp", R"(
        layout(constant_id = 0) const uint which = 1;
        layout(set = 0, binding = 0, scalar) buffer Values { uint values[]; };
        void main() { values[which] = which; })");
    Buffer values = frame.graph.create("values", 64);
    for (const std::uint32_t which : {2u, 3u, 2u}) {
        frame.graph.compute("constant.comp").updates("Values", values).fixes("which", which).groups({});
    }
    frame.graph.keep(values);
    const std::size_t before = shared_executor().pipelines_created();
    for (int run = 0; run < 2; ++run) frame.run();
    EXPECT_EQ(shared_executor().pipelines_created() - before, 2u);
}

TEST(Executor, ReadsZeroWhereTheFrameHasNoImage) {
    TestFrame frame;
    frame.shader("absent.comp", R"(
        layout(set = 0, binding = 0) uniform sampler2DArray real;
        layout(set = 0, binding = 1) uniform usampler2D whole;
        layout(set = 0, binding = 2) uniform sampler3D volume;
        layout(set = 0, binding = 3) uniform sampler2DMS several;
        layout(set = 0, binding = 4, rgba16f) readonly uniform image2DArray stored;
        layout(set = 1, binding = 2, scalar) writeonly buffer Sum { float sum; };
        void main() {
            sum = 1 + texelFetch(real, ivec3(0), 0).x + float(texelFetch(whole, ivec2(0), 0).x) + texture(volume, vec3(0.5)).x +
                  texelFetch(several, ivec2(0), 3).x + imageLoad(stored, ivec3(0)).x;
        })");
    Buffer sum = frame.graph.create("sum", 4);
    frame.graph.compute("absent.comp")
        .samples("real", Image{})
        .samples("whole", Image{})
        .samples("volume", Image{})
        .samples("several", Image{})
        .loads("stored", Image{})
        .stores("Sum", sum)
        .groups({});
    frame.graph.keep(sum);
    EXPECT_THAT(values_of<float>(frame.run().buffers.at(sum.id)), ElementsAre(1));
}

TEST(Executor, ViewsTheMipAndLayerABindingNames) {
    TestFrame frame;
    frame.shader("write_part.comp", R"(
        layout(set = 0, binding = 0, r32f) writeonly uniform image2D part;
        layout(push_constant) uniform Push { float value; };
        void main() { imageStore(part, ivec2(gl_GlobalInvocationID), vec4(value)); })");
    frame.shader("read_parts.comp", R"(
        layout(set = 0, binding = 0) uniform sampler2DArray all;
        layout(set = 0, binding = 1) uniform sampler2D one;
        layout(set = 0, binding = 2, r32f) writeonly uniform image2D result;
        void main() {
            const float mip = textureLod(all, vec3(0.5, 0.5, 1), 1).x;
            imageStore(result, ivec2(0), vec4(mip * 10 + texelFetch(one, ivec2(0), 0).x));
        })");
    Image layered = frame.graph.create("layered", {.extent = {4, 4}, .format = Format::r32f, .layers = 2, .mips = 2});
    Image result = frame.graph.create("result", {.format = Format::r32f});
    frame.graph.clear(layered, {});
    frame.graph.compute("write_part.comp").stores("part", layered, {.mip = 1, .layer = 1}).push(3.0f).over({2, 2});
    frame.graph.compute("write_part.comp").stores("part", layered, {.mip = 0, .layer = 1}).push(5.0f).over({4, 4});
    frame.graph.compute("read_parts.comp")
        .samples("all", layered)
        .samples("one", layered, Filter::nearest, {.mip = 0, .layer = 1})
        .stores("result", result)
        .groups({});
    EXPECT_EQ(texel(frame.result(result), 0, 0).x, 35);
}

TEST(Executor, DispatchesAsManyGroupsAsABufferSays) {
    TestFrame frame;
    frame.shader("count.comp", R"(
        layout(local_size_x = 4) in;
        layout(set = 0, binding = 0, scalar) buffer Count { uint count; };
        void main() { atomicAdd(count, 1); })");
    Buffer groups = import_values<std::uint32_t>(frame.graph, "groups", scratch_id, {99, 5, 2, 1});
    Buffer count = frame.graph.create("count", 4);
    frame.graph.clear(count, 1000);
    frame.graph.compute("count.comp").updates("Count", count).indirect(groups, 4);
    frame.graph.keep(count);
    EXPECT_THAT(values_of<std::uint32_t>(frame.run().buffers.at(count.id)), ElementsAre(1040));
}

TEST(Executor, CountsInTheScopeOfTheTechniqueFromZeroOnEveryRun) {
    TestFrame frame;
    frame.shader("counted.comp", R"(
        layout(local_size_x = 64) in;
        layout(set = 0, binding = 0, scalar) buffer Counters { uint threads; };
        layout(set = 0, binding = 1, r32f) writeonly uniform image2D target;
        void main() {
            const uint all = subgroupAdd(1u);
            if (subgroupElect()) atomicAdd(threads, all);
            imageStore(target, ivec2(gl_GlobalInvocationID), vec4(1));
        })");
    frame.graph.enter({}, 8);
    Image target = frame.graph.create("target", {.extent = {64, 3}, .format = Format::r32f});
    frame.graph.compute("counted.comp").stores("target", target).over({64, 3});
    frame.graph.keep(target);
    const Buffer counters = frame.graph.counters(1);
    for (int run = 0; run < 2; ++run)
        EXPECT_THAT(values_of<std::uint32_t>(frame.run().buffers.at(counters.id)), ElementsAre(192, 0));
}

TEST(Executor, CopiesImagesAndBuffersIntoImportsThatOutliveThePlan) {
    constexpr ImportId kept_image{0x1a6e};
    const Shape shape{.extent = {3, 2}, .format = Format::rgba16f, .layers = 2};
    shared_executor().create_image(kept_image, shape);
    {
        TestFrame frame;
        Image made = frame.graph.create("made", shape), memo = frame.graph.import("memo", shape, kept_image);
        frame.graph.clear(made, {{1, 2, 3, 4}});
        frame.graph.copy(made, memo);
        frame.run();
    }
    TestFrame frame;
    Image memo = frame.graph.import("memo", shape, kept_image), back = frame.graph.create("back", shape);
    frame.graph.copy(memo, back);
    EXPECT_EQ(texel(frame.result(back), 2, 1, 1), glm::dvec4(1, 2, 3, 4));
    shared_executor().forget(kept_image);
}

TEST(Executor, PeeksAtAnImageBetweenSteps) {
    TestFrame frame;
    Image image = frame.graph.create("changing", {.extent = {2, 2}, .format = Format::r32f});
    frame.graph.clear(image, {{1}});
    frame.graph.clear(image, {{2}});
    frame.shader("double.comp", R"(
        layout(set = 0, binding = 0, r32f) uniform image2D image;
        void main() { const ivec2 at = ivec2(gl_GlobalInvocationID); imageStore(image, at, 2 * imageLoad(image, at)); })");
    for (int i = 0; i < 3; ++i) frame.graph.compute("double.comp").updates("image", image).over({2, 2});
    frame.graph.keep(image);
    const Plan plan = frame.plan();  // the first clear is culled
    const auto run = shared_executor().run(plan, {.peeks = {{2, image}, {0, image}, {3, image}}});
    ASSERT_THAT(run.peeked, SizeIs(3));
    EXPECT_EQ(texel(run.peeked[0], 1, 1).x, 8);
    EXPECT_EQ(texel(run.peeked[1], 1, 1).x, 2);
    EXPECT_EQ(texel(run.images.at(image.id), 1, 1).x, 16);
}

TEST(Executor, SaysWhenThereIsNothingToPeekAt) {
    TestFrame frame;
    Image first = frame.graph.create("first", {.format = Format::r32f}),
          second = frame.graph.create("second", {.format = Format::r16f});
    frame.graph.clear(first, {{1}});
    frame.graph.clear(second, {{1}});
    frame.graph.keep(first);
    frame.graph.keep(second);
    EXPECT_THROW(frame.run({.peeks = {{0, second}}}), DeviceFailure);
}

TEST(Executor, StopsAfterTheStepItIsTold) {
    TestFrame frame;
    Image early = frame.graph.create("early", {.format = Format::r32f}),
          late = frame.graph.create("late", {.format = Format::r16f});
    frame.graph.clear(early, {{1}});
    frame.graph.clear(late, {{1}});
    frame.graph.keep(early);
    frame.graph.keep(late);
    const Execution run = frame.run({.until = 0});
    EXPECT_TRUE(run.images.contains(early.id));
    EXPECT_FALSE(run.images.contains(late.id));
}

TEST(Executor, TimesEveryStep) {
    TestFrame frame;
    frame.shader("busy.comp", R"(
        layout(local_size_x = 64) in;
        layout(set = 0, binding = 0, scalar) buffer Sums { float sums[]; };
        void main() {
            float sum = sums[gl_GlobalInvocationID.x];
            for (uint i = 0; i < 4000; ++i) sum = sum * 1.0001 + 0.5;
            sums[gl_GlobalInvocationID.x] = sum;
        })");
    Buffer sums = frame.graph.create("sums", 4 * 65536);
    frame.graph.clear(sums, 0);
    for (int i = 0; i < 4; ++i) frame.graph.compute("busy.comp").updates("Sums", sums).over({65536, 1});
    frame.graph.keep(sums);
    frame.run();  // compiles
    const Execution run = frame.run({.timestamps = Timestamps::on});
    ASSERT_THAT(run.step_costs, SizeIs(5));
    EXPECT_THAT(run.step_costs, Each(testing::Field(&StepCost::ms, Gt(0))));
    EXPECT_FALSE(run.step_costs[1].invocations) << "nothing is counted while something is timed";
    ASSERT_TRUE(run.empty_step_ms);
    EXPECT_GT(*run.empty_step_ms, 0);
    EXPECT_LT(*run.empty_step_ms, run.step_costs[1].ms);
    // A clear runs no shader, a dispatch one per thread: where the device counts them.
    const Execution counted = frame.run({.invocations = Invocations::counted});
    ASSERT_THAT(counted.step_costs, SizeIs(5));
    if (counted.step_costs[0].invocations) {
        EXPECT_EQ(counted.step_costs[0].invocations, 0u);
        EXPECT_EQ(counted.step_costs[1].invocations, 65536u);
    }
    double sum = 0;
    for (const StepCost& cost : run.step_costs) sum += cost.ms;
    RecordProperty("sum_of_wall_percent", static_cast<int>(100 * sum / run.host_ms.render));
    fmt::print("steps sum to {:.2f} of {:.2f} ms wall\n", sum, run.host_ms.render);
    for (const std::size_t steps : {1u, 1000u}) {
        const Execution whole = frame.run({.timestamps = Timestamps::around_all, .steps_per_submit = steps});
        EXPECT_THAT(whole.step_costs, SizeIs(0));
        EXPECT_FALSE(whole.empty_step_ms);
        ASSERT_TRUE(whole.all_steps_ms);
        EXPECT_GT(*whole.all_steps_ms, sum / 3) << "all steps and not the last";  // a busy machine is as slow as it likes
    }
}

/// Images of a frame whose steps depend on each other, one of them looked at on the way.
TEST(Executor, SubmitsAFrameInPiecesThatGiveTheSameBits) {
    TestFrame frame;
    frame.shader("next.comp", R"(
        layout(local_size_x = 8, local_size_y = 8) in;
        layout(set = 0, binding = 0, rgba32f) uniform image2DArray target;
        layout(set = 0, binding = 1, scalar) buffer Sums { uint sums[]; };
        void main() {
            const ivec3 at = ivec3(gl_GlobalInvocationID);
            const vec4 before = imageLoad(target, at);
            atomicAdd(sums[0], 1);
            imageStore(target, at, before * 1.25 + vec4(at, 1));
        })");
    Image image = frame.graph.create("image", {.extent = {8, 8}, .format = Format::rgba32f}),
          last = frame.graph.create("last", {.extent = {8, 8}, .format = Format::rgba32f});
    Buffer sums = frame.graph.create("sums", 4);
    frame.graph.clear(image, {{1, 2, 3, 4}});
    frame.graph.clear(sums, 0);
    for (int i = 0; i < 5; ++i) frame.graph.compute("next.comp").updates("target", image).updates("Sums", sums).over({8, 8});
    frame.graph.copy(image, last);
    frame.graph.keep(last);
    frame.graph.keep(sums);
    const RunOptions whole{.peeks = {{.step = 3, .image = image}}, .timestamps = Timestamps::on, .steps_per_submit = 1000};
    const Execution expected = frame.run(whole);
    EXPECT_EQ(values_of<std::uint32_t>(expected.buffers.at(sums.id)), std::vector<std::uint32_t>{5 * 64});
    for (const std::size_t steps : {1u, 3u, 7u, 8u}) {
        RunOptions options = whole;
        options.steps_per_submit = steps;
        const Execution run = frame.run(options);
        EXPECT_EQ(run.images.at(last.id).texels, expected.images.at(last.id).texels) << steps;
        EXPECT_EQ(run.peeked.at(0).texels, expected.peeked.at(0).texels) << steps;
        EXPECT_EQ(run.buffers.at(sums.id), expected.buffers.at(sums.id)) << steps;
        ASSERT_THAT(run.step_costs, SizeIs(8));
        EXPECT_THAT(run.step_costs, Each(testing::Field(&StepCost::ms, Gt(0))));
    }
}

TEST(Executor, NamesTheStepThatFails) {
    TestFrame frame;
    Image image = frame.graph.create("missing import", {.format = Format::r32f});
    frame.graph.enter({ScopeKind::pass, Stage::rain, Stage::film, "rain/some"});
    frame.graph.clear(image, {{1}});
    frame.graph.keep(image);
    Plan plan = frame.plan();
    plan.steps[0].step.work = ClearWork{.buffer = Buffer{0, 0}};
    plan.buffers.push_back({.name = "nobody made it", .bytes = 4, .import = ImportId{0xdead}});
    try {
        shared_executor().run(plan, {});
        FAIL() << "it ran";
    } catch (const DeviceFailure& failure) {
        EXPECT_THAT(failure.what(), testing::HasSubstr("film: rain/some / clear missing import"));
    }
}

std::uint64_t held() {
    const DeviceMemory memory = shared_executor().memory();
    return memory.plan + memory.imports;
}

TEST(Executor, HoldsTheMemoryOfTheLatestPlanOnly) {
    const std::uint64_t before = [] {
        TestFrame small;
        Image image = small.graph.create("small", {.extent = {4, 4}, .format = Format::r32f});
        small.graph.clear(image, {});
        small.result(image);
        return held();
    }();
    TestFrame large;
    Image image = large.graph.create("large", {.extent = {512, 512}, .format = Format::rgba32f});
    large.graph.clear(image, {});
    large.result(image);
    EXPECT_GE(held(), before + 4'000'000);
    EXPECT_LE(held(), before + 6'000'000);
}

}  // namespace
}  // namespace strata
