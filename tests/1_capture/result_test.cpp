// A Result handed on: and_then() calls what follows only where there is a value, and keeps the error where there is none.
#include <memory>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "capture_format/result.h"

namespace strata {
namespace {

Result<int> four() { return 4; }
Result<int> refused() { return fail(Fault::usage, "test.no", "no"); }
Result<void> done() { return {}; }
Result<void> not_done() { return fail(Fault::bad_input, "test.cut", "cut"); }

TEST(Result, HandsItsValueOn) {
    const Result<std::string> text = four().and_then([](int value) { return std::string(static_cast<std::size_t>(value), 'x'); });
    EXPECT_EQ(*text, "xxxx");
    const Result<int> failed = four().and_then([](int) { return refused(); });
    EXPECT_EQ(failed.error().sentence, "no");
    EXPECT_EQ(*done().and_then([] { return four(); }), 4);
}

TEST(Result, KeepsItsErrorAndCallsNothing) {
    bool called = false;
    const Result<std::string> text = refused().and_then([&](int) {
        called = true;
        return std::string();
    });
    EXPECT_EQ(text.error().fault, Fault::usage);
    const Result<void> next = not_done().and_then([&]() -> Result<void> {
        called = true;
        return {};
    });
    EXPECT_EQ(next.error().sentence, "cut");
    EXPECT_FALSE(called);
}

TEST(Result, AnErrorHasAnIdAndTheValuesOfItsSentenceByName) {
    const Error error =
        fail(Fault::bad_input, "test.accessor_range", "accessor {accessor} needs {bytes} bytes of {share:.1f} in '{name}' {{}}",
             3, std::uint64_t{1} << 40, .25, "a.bin");
    EXPECT_EQ(error.sentence, "accessor 3 needs 1099511627776 bytes of 0.2 in 'a.bin' {}");
    EXPECT_EQ(error.id.text(), "test.accessor_range");
    ASSERT_EQ(error.fields.size(), 4u);
    EXPECT_EQ(std::get<std::int64_t>(error.field("accessor")->value), 3);
    EXPECT_EQ(std::get<std::uint64_t>(error.field("bytes")->value), std::uint64_t{1} << 40);
    EXPECT_EQ(std::get<double>(error.field("share")->value), .25) << "as it is, not as it is printed";
    EXPECT_EQ(std::get<std::string>(error.field("name")->value), "a.bin");
    EXPECT_EQ(error.field("missing"), nullptr);
}

TEST(Result, EveryKindOfErrorHasAName) {
    std::set<std::string_view> names;
    for (const int code : {1, 2, 3, 4, 5, 6, 7, 8, 130}) names.insert(name(static_cast<Fault>(code)));
    EXPECT_EQ(names.size(), 9u);
    EXPECT_FALSE(names.contains("unknown"));
    EXPECT_EQ(name(Fault::over_tolerance), "over_tolerance");
}

TEST(Result, WhatWrapsAnErrorKeepsItsIdAndFields) {
    const Error inner = fail(Fault::device_lacks, "test.too_large", "{bytes} bytes", 7);
    const Error outer = within(inner, "frame {frame}", 2);
    EXPECT_EQ(outer.sentence, "frame 2: 7 bytes");
    EXPECT_EQ(outer.id.text(), "test.too_large");
    EXPECT_EQ(outer.fault, Fault::device_lacks);
    EXPECT_EQ(std::get<std::int64_t>(outer.field("bytes")->value), 7);
    EXPECT_EQ(std::get<std::int64_t>(outer.field("frame")->value), 2);
}

TEST(Result, LetsWhatFollowsTakeTheValueAway) {
    Result<std::unique_ptr<int>> made = std::make_unique<int>(7);
    EXPECT_EQ(**std::move(made).and_then([](auto& value) { return std::move(value); }), 7);
}

}  // namespace
}  // namespace strata
