// A Result handed on: and_then() calls what follows only where there is a value, and keeps the error where there is none.
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "capture_format/result.h"

namespace strata {
namespace {

Result<int> four() { return 4; }
Result<int> refused() { return fail(Fault::usage, "no"); }
Result<void> done() { return {}; }
Result<void> not_done() { return fail(Fault::bad_input, "cut"); }

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

TEST(Result, LetsWhatFollowsTakeTheValueAway) {
    Result<std::unique_ptr<int>> made = std::make_unique<int>(7);
    EXPECT_EQ(**std::move(made).and_then([](auto& value) { return std::move(value); }), 7);
}

}  // namespace
}  // namespace strata
