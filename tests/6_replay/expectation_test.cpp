// What a replay is expected to give: the order in which it is judged, and what is said when it is something else.
#include <limits>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/expectation_writer.h"
#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "passes/frame_images.h"
#include "replay/expectations/expectation_check.h"
#include "replay/expectations/expectation_keys.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr Shape small{.extent = {4, 2, 1}, .format = Format::r32f};

HostImage image_of(const std::vector<float>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return {small, {bytes.begin(), bytes.end()}};
}

/// A frame of two passes with an image each; the second one's texels are given, the first one's perhaps.
struct Given {
    Run run;
    Expectation expectation;

    explicit Given(const std::vector<float>& second, std::string device = "this device")
        : Given({1, 2, 3, 4, 5, 6, 7, 8}, second, std::move(device)) {}
    Given(const std::vector<float>& first, const std::vector<float>& second, std::string device = "this device") {
        run.passes = {{Stage::gbuffer, Stage::gbuffer, "gbuffer", "gbuffer/any", {}},
                      {Stage::lighting, Stage::lighting, "lighting", "lighting/any strength=2", {}}};
        run.passes[0].images["normal"] = image_of(first);
        run.passes[1].images["color"] = image_of(second);
        expectation.on = {
            .device = std::move(device), .driver = "driver", .driver_version = "1", .cpu = "cpu", .vector_width = 8};
        for (const PassImages& pass : run.passes) {
            expectation.passes.push_back({pass.label, pass.choice, {}});
            for (const auto& [name, image] : pass.images)
                expectation.passes.back().images.push_back({name, hash_of(image), image.shape, ""});
        }
    }
};

/// Accepted beside what was accepted before.
Given also(Given given) {
    given.expectation.also = true;
    return given;
}

/// A capture that expects what it is told to, in that order.
class Expecting {
public:
    enum class Images { kept, left };
    explicit Expecting(std::vector<Given> given, Images images = Images::left) {
        Recorder recorder = must(Recorder::create(path_));
        must(recorder.record(scenario_frames("empty").front()));
        must(recorder.finish());
        ExpectationWriter writer = must(ExpectationWriter::extend(path_));
        for (Given& one : given) {
            for (std::size_t i = 0; images == Images::kept && i < one.run.passes.size(); ++i)
                for (ExpectedImage& image : one.expectation.passes[i].images)
                    image.texels = writer.add_image(one.run.passes[i].images.at(image.name).texels);
            must(writer.add(as_json(one.expectation)));
        }
        must(writer.finish());
    }
    ~Expecting() { std::filesystem::remove(path_); }

    ExpectationVerdict verdict(const Given& got, double tolerance = 0) const {
        const Capture capture = must(Capture::open(path_));
        return must(check_expectations(capture, must(expectations_of(capture)), got.run, got.expectation, tolerance));
    }

private:
    std::filesystem::path path_ = std::filesystem::path(testing::TempDir()) / "expecting.strata";
};

const std::vector<float> plain = {1, 1, 1, 1, 1, 1, 1, 1}, brighter = {1, 1, 1, 1, 1, 1.25f, 1, 1},
                         darker = {1, 1, 1, 1, 1, .25f, 1, 1};

TEST(Expectation, SurvivesJson) {
    Expectation e = Given(plain).expectation;
    e.frame = 3, e.samples = 4, e.forced = {"rain"}, e.tool = "0123456789ab";
    e.also = true;
    e.passes[0].images[0].texels = std::string(32, 'a');
    const Expectation again = must(parse_expectation(as_json(e)));
    EXPECT_EQ(as_json(again), as_json(e));
    EXPECT_TRUE(same_frame_and_choices(again, e));
    EXPECT_EQ(again.on, e.on);
    EXPECT_EQ(again.passes[1].images[0].shape, small);
    EXPECT_TRUE(again.also);
}

TEST(Expectation, WithoutTheKeyAlsoReplacesWhatWasAcceptedBefore) {
    const std::string json = as_json(Given(plain).expectation);
    EXPECT_THAT(json, Not(HasSubstr("also")));
    EXPECT_FALSE(must(parse_expectation(json)).also);
    for (const char* value : {"\"yes\"", "1", "null", "[]"}) {
        const auto parsed = parse_expectation(fmt::format("{{\"also\":{},{}", value, json.substr(1)));
        ASSERT_FALSE(parsed) << value;
        EXPECT_EQ(parsed.error().fault, Fault::bad_input) << value;
    }
}

TEST(Expectation, OfTheFirstSchemaVersionIsRead) {
    const Expectation e = Given(plain).expectation;
    std::string first = as_json(e);
    const ExpectationKeys now = expectation_keys(expectation_version), then = expectation_keys(1);
    const auto replace = [&](const std::string& from, const std::string& to) {
        for (std::size_t at = first.find(from); at != std::string::npos; at = first.find(from, at + to.size()))
            first.replace(at, from.size(), to);
    };
    replace(fmt::format("\"schema_version\":{}", expectation_version), "\"schema_version\":1");
    replace(fmt::format("\"{}\"", now.passes), fmt::format("\"{}\"", then.passes));
    replace(fmt::format("\"{}\"", now.pass), fmt::format("\"{}\"", then.pass));
    ASSERT_NE(first, as_json(e));
    EXPECT_EQ(as_json(must(parse_expectation(first))), as_json(e));
}

TEST(Expectation, WhatIsNoneIsBadInput) {
    for (const char* text : {"", "display 1234", "{}", "[]", R"({"schema": "strata.expectation", "schema_version": 3})"}) {
        const auto parsed = parse_expectation(text);
        ASSERT_FALSE(parsed) << text;
        EXPECT_EQ(parsed.error().fault, Fault::bad_input) << text;
    }
}

TEST(Expectation, EqualHashesAreExact) {
    const auto verdict = Expecting({Given(plain)}).verdict(Given(plain));
    EXPECT_EQ(verdict.agreement, Agreement::exact);
    EXPECT_FALSE(verdict.elsewhere);
    EXPECT_EQ(verdict.images.size(), 2u);
}

TEST(Expectation, TheFirstPassThatDivergesIsNamed) {
    const auto verdict = Expecting({Given(plain)}).verdict(Given(brighter));
    ASSERT_EQ(verdict.agreement, Agreement::diverges);
    EXPECT_EQ(verdict.first_divergence()->pass, "lighting");
    EXPECT_THAT(sentence(*verdict.first_divergence()), HasSubstr("lighting: 'color' has hash"));
}

TEST(Expectation, WithImagesTheWorstTexelIsNamedWithBothValues) {
    const auto verdict = Expecting({Given(plain)}, Expecting::Images::kept).verdict(Given(brighter));
    ASSERT_EQ(verdict.agreement, Agreement::diverges);
    const ImageDeviation& deviation = *verdict.first_divergence()->deviation;
    EXPECT_EQ(deviation.differing, 1u);
    EXPECT_EQ(deviation.worst.x, 1u);
    EXPECT_EQ(deviation.worst.y, 1u);
    EXPECT_EQ(deviation.worst.got.x, 1.25);
    EXPECT_EQ(deviation.worst.wanted.x, 1);
    EXPECT_DOUBLE_EQ(deviation.rmse, .25 / std::sqrt(8));  // of a mean square of 1
}

TEST(Expectation, AToleranceCountsWhereImagesAreKept) {
    const Expecting with(std::vector{Given(plain)}, Expecting::Images::kept);
    EXPECT_EQ(with.verdict(Given(brighter), .1).agreement, Agreement::within_tolerance);
    EXPECT_EQ(with.verdict(Given(brighter), .08).agreement, Agreement::diverges);
    EXPECT_EQ(Expecting({Given(plain)}).verdict(Given(brighter), .1).agreement, Agreement::diverges);
}

TEST(Expectation, LightWhereBlackIsExpectedIsWithinNoTolerance) {
    const std::vector<float> black(plain.size(), 0);
    std::vector<float> speck = black;
    speck[0] = 1e-6f;
    EXPECT_EQ(Expecting({Given(black)}, Expecting::Images::kept).verdict(Given(speck), .1).agreement, Agreement::diverges);
}

TEST(Expectation, WhatIsNotANumberIsOnlyLikeItself) {
    std::vector<float> broken = plain;
    broken[3] = std::numeric_limits<float>::quiet_NaN();
    const Expecting numbers({Given(plain)}, Expecting::Images::kept);
    EXPECT_EQ(numbers.verdict(Given(broken), 1e9).agreement, Agreement::diverges);
    std::vector<float> both = broken;
    both[0] = 1.001f;
    EXPECT_EQ(Expecting({Given(broken)}, Expecting::Images::kept).verdict(Given(both), .01).agreement,
              Agreement::within_tolerance);
}

TEST(Expectation, TheNewestForADeviceCounts) {
    const Expecting capture({Given(plain), Given(brighter)});
    EXPECT_EQ(capture.verdict(Given(brighter)).agreement, Agreement::exact);
    EXPECT_EQ(capture.verdict(Given(plain)).agreement, Agreement::diverges);
}

TEST(Expectation, SeveralAreAcceptedUntilOneReplacesThem) {
    const Expecting two({Given(plain), also(Given(brighter))});
    EXPECT_EQ(two.verdict(Given(plain)).agreement, Agreement::exact);
    EXPECT_EQ(two.verdict(Given(brighter)).agreement, Agreement::exact);
    EXPECT_EQ(two.verdict(Given(darker)).agreement, Agreement::diverges);
    const Expecting replaced({Given(plain), also(Given(brighter)), Given(darker), also(Given(brighter))});
    EXPECT_EQ(replaced.verdict(Given(plain)).agreement, Agreement::diverges);
    EXPECT_EQ(replaced.verdict(Given(darker)).agreement, Agreement::exact);
}

TEST(Expectation, EachImageMayAgreeWithAnotherAcceptedResult) {
    const Expecting two({Given(plain, brighter), also(Given(brighter, plain))});
    EXPECT_EQ(two.verdict(Given(plain, plain)).agreement, Agreement::exact);
    const auto verdict = two.verdict(Given(plain, darker));
    EXPECT_EQ(verdict.agreement, Agreement::diverges);
    EXPECT_EQ(verdict.first_divergence()->pass, "lighting");
}

TEST(Expectation, TheNearestAcceptedImageIsNamed) {
    for (const std::vector<Given>& accepted :
         {std::vector{Given(plain), also(Given(darker))}, {Given(darker), also(Given(plain))}}) {
        const Expecting two(accepted, Expecting::Images::kept);
        const auto diverged = two.verdict(Given(brighter));
        ASSERT_EQ(diverged.agreement, Agreement::diverges);
        EXPECT_EQ(diverged.first_divergence()->deviation->worst.wanted.x, 1);
        EXPECT_THAT(sentence(*diverged.first_divergence()), HasSubstr("the nearest of 2 accepted results"));
        EXPECT_EQ(two.verdict(Given(brighter), .1).agreement, Agreement::within_tolerance);
    }
}

TEST(Expectation, WithoutImagesTheNewestAcceptedResultIsNamed) {
    const Given newest(darker);
    const auto verdict = Expecting({Given(plain), also(newest)}).verdict(Given(brighter));
    const std::string said = sentence(*verdict.first_divergence());
    EXPECT_THAT(said, HasSubstr(newest.expectation.passes[1].images[0].hash + ", the newest of 2 accepted results"));
}

TEST(Expectation, ResultsAreAcceptedByDeviceFrameAndChoice) {
    Given other_frame(plain);
    other_frame.expectation.frame = 1;
    const Expecting capture({Given(plain), Given(darker, "elsewhere"), other_frame, also(Given(brighter))});
    EXPECT_EQ(capture.verdict(Given(plain)).agreement, Agreement::exact);
    EXPECT_EQ(capture.verdict(Given(darker)).agreement, Agreement::diverges);
}

TEST(Expectation, OtherChoicesAndOtherFramesExpectNothing) {
    const Expecting capture({Given(plain)});
    Given other_choice(plain), other_frame(plain);
    other_choice.expectation.passes[1].choice = "lighting/any strength=3";
    other_frame.expectation.frame = 1;
    EXPECT_EQ(capture.verdict(other_choice).agreement, Agreement::no_expectation);
    EXPECT_EQ(capture.verdict(other_frame).agreement, Agreement::no_expectation);
}

TEST(Expectation, AnotherDevicesCountsWhenMetExactlyOrWithinATolerance) {
    const Expecting capture({Given(plain, "elsewhere")}, Expecting::Images::kept);
    const auto exact = capture.verdict(Given(plain));
    EXPECT_EQ(exact.agreement, Agreement::exact);
    EXPECT_EQ(exact.elsewhere->device, "elsewhere");
    EXPECT_EQ(capture.verdict(Given(brighter)).agreement, Agreement::no_expectation);
    EXPECT_EQ(capture.verdict(Given(brighter), .1).agreement, Agreement::within_tolerance);
    EXPECT_EQ(capture.verdict(Given(brighter), .01).agreement, Agreement::diverges);
}

TEST(Expectation, AllThatAnotherDeviceAcceptsCountsAndNothingThatItReplaced) {
    const Expecting capture({Given(darker, "elsewhere"), Given(plain, "elsewhere"), also(Given(brighter, "elsewhere"))});
    EXPECT_EQ(capture.verdict(Given(plain)).agreement, Agreement::exact);
    EXPECT_EQ(capture.verdict(Given(brighter)).agreement, Agreement::exact);
    EXPECT_EQ(capture.verdict(Given(darker)).agreement, Agreement::no_expectation);
}

TEST(Expectation, ThisDevicesOwnDecidesEvenWhereAnotherAgrees) {
    const Expecting capture({Given(brighter), Given(plain, "elsewhere")});
    EXPECT_EQ(capture.verdict(Given(plain)).agreement, Agreement::diverges);
}

TEST(Expectation, AnImageMoreOrLessDiverges) {
    Given more(plain);
    more.run.passes[0].images["extra"] = image_of(plain);
    more.expectation.passes[0].images.insert(more.expectation.passes[0].images.begin(), {"extra", "0", small, ""});
    EXPECT_THAT(sentence(*Expecting({Given(plain)}).verdict(more).first_divergence()), HasSubstr("was not expected at all"));
    EXPECT_THAT(sentence(*Expecting({more}).verdict(Given(plain)).first_divergence()), HasSubstr("is not there"));
}

TEST(Expectation, AnImageThatAnAcceptedResultLacksMayBeMissing) {
    Given more(plain);
    more.run.passes[0].images["extra"] = image_of(plain);
    more.expectation.passes[0].images.push_back({"extra", "0", small, ""});
    for (const std::vector<Given>& accepted : {std::vector{more, also(Given(plain))}, {Given(plain), also(more)}}) {
        const Expecting either(accepted);
        EXPECT_EQ(either.verdict(more).agreement, Agreement::exact);
        EXPECT_EQ(either.verdict(Given(plain)).agreement, Agreement::exact);
    }
}

}  // namespace
}  // namespace strata
