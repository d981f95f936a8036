// A capture that is cut, empty, forged or newer than the tool shows a sentence, and the inspector goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/7_inspector/desk.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/support/session.h"

namespace strata::ui {
namespace {

using testing::HasSubstr;

/// What an inspector says that is opened on a file of these bytes, every panel in front once.
std::string said_of(std::span<const std::byte> bytes) {
    Desk& desk = Desk::clean();
    const TemporaryFile file("bad.strata");
    write_file(file.path(), bytes);
    Inspector inspector(
        *desk.layer, Model(file.path(), {.validation = true}, {}),
        [path = file.path()] { return Session::open(path, {.validation = true}); }, Layout());
    Player player(inspector, *desk.layer, {1280, 800});
    must(player.wait());
    for (const PanelRow& row : panels()) must(player.click(fmt::format("tabs/{}", row.name)));
    EXPECT_TRUE(inspector.widgets().conflicts().empty());
    const WidgetRecord* error = inspector.widgets().find("status/error");
    if (!error) return "";
    EXPECT_THAT(inspector.log().back().text, HasSubstr(error->value));
    return inspector.log().back().text;
}

/// How the sentence begins that refuses the capture or one of its frames.
std::string beginning_of_refusal(std::span<const std::byte> bytes) {
    const auto capture = Capture::open(bytes, "bad.strata");
    if (!capture) return capture.error().sentence.substr(0, 40);
    for (std::size_t i = 0; i < capture->frame_count(); ++i)
        if (const auto frame = capture->frame(i); !frame) return frame.error().sentence.substr(0, 40);
    return "no refusal";
}

TEST(BadCaptures, ThatLieShowTheSentenceThatRefusesThem) {
    for (const ForgedCapture& forged : forged_captures()) {
        SCOPED_TRACE(forged.name);
        EXPECT_THAT(said_of(forged.bytes), HasSubstr(beginning_of_refusal(forged.bytes)));
    }
}

TEST(BadCaptures, ThatAreCutOrEmptyShowASentence) {
    const std::vector<std::byte> good = sound_capture();
    for (const std::size_t size : {good.size() - 1, good.size() / 2, std::size_t{16}, std::size_t{3}, std::size_t{0}}) {
        SCOPED_TRACE(size);
        EXPECT_THAT(said_of(std::span(good).first(size)), HasSubstr("bad.strata"));
    }
}

}  // namespace
}  // namespace strata::ui
