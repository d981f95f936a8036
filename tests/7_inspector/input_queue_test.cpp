// What is shorter than a frame of the window happens all the same, where and in the order in which it did.
#include <cfloat>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "passes/stage_input.h"
#include "ui/window/input_queue.h"
#include "ui/window/keys.h"

namespace strata::ui {
namespace {

/// What Dear ImGui's backend leaves before a frame: the mouse somewhere in the window.
struct Input {
    InputQueue queue;
    ImGuiIO io;
    ImGuiIO& frame() {
        io.MousePos = {1, 1};
        io.MouseWheel = 0;
        queue.begin_frame(io);
        return io;
    }
};

TEST(InputQueue, AKeyThatIsLetGoWithinAFrameWasDownInIt) {
    Input input;
    const int r = chord_of("r")->key;
    for (const bool is_down : {true, false, true, false}) input.queue.key(r, is_down);
    for (const bool is_down : {true, false, true, false}) EXPECT_EQ(input.frame().KeysDown[r], is_down);
}

TEST(InputQueue, AKeyIsDownWithTheModifiersThatWereDownWhenItWas) {
    Input input;
    const int f12 = chord_of("f12")->key;
    input.queue.key(GLFW_KEY_LEFT_SHIFT, true);
    input.queue.key(f12, true);
    input.queue.key(GLFW_KEY_LEFT_SHIFT, false);
    input.queue.key(f12, false);
    EXPECT_TRUE(input.frame().KeysDown[f12]);
    EXPECT_TRUE(input.io.KeyShift);
    EXPECT_TRUE(input.frame().KeysDown[f12]);
    EXPECT_FALSE(input.io.KeyShift);
    EXPECT_FALSE(input.frame().KeysDown[f12]);
}

TEST(InputQueue, AClickIsWhereTheMouseWasAndNotWhereItWentAfterwards) {
    Input input;
    input.queue.move({10, 20});
    input.queue.button(0, true);
    input.queue.button(0, false);
    input.queue.move({300, 400});
    EXPECT_FALSE(input.frame().MouseDown[0]) << "what is under it is known in the next";
    EXPECT_EQ(input.io.MousePos.x, 10);
    EXPECT_TRUE(input.frame().MouseDown[0]);
    EXPECT_EQ(input.io.MousePos.x, 10);
    EXPECT_FALSE(input.frame().MouseDown[0]);
    EXPECT_EQ(input.io.MousePos.x, 10);
    EXPECT_EQ(input.frame().MousePos.x, 300);
}

TEST(InputQueue, ADragEndsWhereTheMouseWasSeenToBe) {
    Input input;
    input.queue.button(0, true);
    input.frame();
    input.queue.move({50, 0});
    input.queue.move({90, 0});
    input.queue.button(0, false);
    EXPECT_TRUE(input.frame().MouseDown[0]);
    EXPECT_EQ(input.io.MousePos.x, 90);
    EXPECT_FALSE(input.frame().MouseDown[0]);
}

TEST(InputQueue, TheWheelTurnsWhereTheMouseWasAndStepsAddUp) {
    Input input;
    input.queue.wheel({0, 1});
    input.queue.wheel({0, 1});
    input.queue.move({50, 0});
    EXPECT_EQ(input.frame().MouseWheel, 2);
    EXPECT_EQ(input.io.MousePos.x, 1) << "as the backend says, before it moved";
    EXPECT_EQ(input.frame().MouseWheel, 0);
    EXPECT_EQ(input.io.MousePos.x, 50);
}

TEST(InputQueue, TextGoesToWhatWasClickedBefore) {
    Input input;
    input.queue.button(0, true);
    input.queue.text('a');
    EXPECT_EQ(input.frame().InputQueueCharacters.size(), 0);
    EXPECT_EQ(input.frame().InputQueueCharacters.size(), 1);
}

TEST(InputQueue, TheMouseThatLeftTheWindowIsNowhere) {
    Input input;
    input.queue.move({50, 0});
    input.frame();
    input.io.MousePos = {-FLT_MAX, -FLT_MAX};
    input.queue.begin_frame(input.io);
    EXPECT_EQ(input.io.MousePos.x, -FLT_MAX);
}

}  // namespace
}  // namespace strata::ui
