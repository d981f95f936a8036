// Nothing is shown undimmed under a label that is not its own: every selector is changed while the session is held up.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"
#include "tests/support/shader_folder.h"
#include "ui/picture/eye_lag.h"

namespace strata::ui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The session does nothing else until this goes.
class HeldUp {
public:
    explicit HeldUp(Desk& desk) {
        job_ = desk.inspector->replayer().start<int>(
            [this](Session&, ui::Progress&) -> Result<int> {
                began_ = true;
                while (!done_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                return 0;
            },
            Yields::between_steps);
        // A picture that is asked for before this began would be made before it.
        while (!began_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    HeldUp(const HeldUp&) = delete;
    ~HeldUp() {
        done_ = true;
        while (!job_->result()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

private:
    std::atomic<bool> began_ = false, done_ = false;
    JobOf<int> job_;
};

struct Selector {
    std::string name;
    std::function<void(Desk&)> change;
    std::vector<std::string> not_its_own;  ///< widgets that show what was made before
};

const std::string tab_of(const std::string& path) { return fmt::format("tabs/{}", path.substr(0, path.find('/'))); }

void bring_to_front(Desk& desk, const Selector& selector) {
    for (const std::string& path : selector.not_its_own)
        if (desk.widget(tab_of(path)).value != "selected") must(desk.player->click(tab_of(path)));
    must(desk.player->wait());
}

void expect_dimmed_until_made(Desk& desk, const Selector& selector) {
    SCOPED_TRACE(selector.name);
    bring_to_front(desk, selector);
    for (const std::string& path : selector.not_its_own) EXPECT_EQ(desk.widget(path).updating, "") << path;
    {
        const HeldUp held(desk);
        selector.change(desk);
        must(desk.player->frames(3));
        for (const std::string& path : selector.not_its_own)
            EXPECT_THAT(desk.widget(path).updating, HasSubstr("updating")) << path;
    }
    must(desk.player->wait());
    for (const WidgetRecord& record : desk.inspector->widgets().records()) EXPECT_EQ(record.updating, "") << record.path;
}

void use_weighted(Desk& desk) { desk.model().use(*must(find_technique("transparency/weighted"))); }
void show_color(Desk& desk) { desk.model().image = {.name = "color"}; }

/// Of the plan's last step that writes an image of its own.
ImageChoice written_by_the_last_step(Desk& desk) {
    const std::vector<PlanRow>& steps = desk.replay()->steps;
    for (std::size_t i = steps.size(); i-- > 0;)
        if (!steps[i].images.empty()) return {.name = steps[i].images.front(), .step = i};
    throw std::runtime_error("no step writes an image");
}

TEST(Updating, EverySelectorDimsWhatWasMadeBeforeIt) {
    Desk& desk = Desk::clean();
    const std::vector<std::string> image = {"Image/picture", "Image/range", "Image/pinned"};
    const std::vector<std::string> frame = {"Image/picture", "Image/pinned", "Frame/executed"};
    const std::vector<std::string> capture = {"Image/picture", "Frame/executed", "Techniques/transparency/technique"};
    const std::vector<std::string> all = {"Image/picture", "Image/pinned"};
    const Selector selectors[] = {
        {"technique", use_weighted, frame},
        {"frame", [](Desk& at) { at.model().select_frame(1); }, capture},
        {"eye", [](Desk& at) { at.model().look_from({.dolly = .5}); }, all},
        {"samples", [](Desk& at) { at.model().set_samples(4); }, all},
        {"image", show_color, image},
        {"step", [](Desk& at) { at.model().image = written_by_the_last_step(at); }, all},
        {"back to display", [](Desk& at) { at.model().image = {}; }, {}},
    };
    desk.model().pin = glm::ivec2(40, 20);
    for (const Selector& selector : selectors) expect_dimmed_until_made(desk, selector);
}

TEST(Updating, ComparisonsAreDimmedUntilTheyAreOfTheirSides) {
    Desk& desk = Desk::clean();
    must(desk.player->click("tabs/Compare"));
    must(desk.player->choose("Compare/A/source", "as recorded"));
    must(desk.player->choose("Compare/B/source", "this replay"));
    use_weighted(desk);
    must(desk.player->wait());
    const std::vector<std::string> numbers = {"Compare/picture", "Compare/rmse", "Compare/flip mean", "Compare/worst",
                                              "Compare/differing"};
    const auto other = [](Desk& at) { at.model().use(*must(find_technique("transparency/alpha_blend"))); };
    for (const char* mode : {"Wipe", "Difference", "Relative", "FLIP"}) {
        SCOPED_TRACE(mode);
        use_weighted(desk);
        must(desk.player->click(fmt::format("Compare/{}", mode)));
        must(desk.player->wait());
        expect_dimmed_until_made(desk, {"technique", other, numbers});
    }
    expect_dimmed_until_made(
        desk, {"source", [](Desk& at) { must(at.player->choose("Compare/A/source", "other technique")); }, numbers});
    must(desk.player->choose("Compare/A/source", "as recorded"));
    must(desk.player->wait());
    expect_dimmed_until_made(desk, {"image", [](Desk& at) { at.model().image = {.name = "color"}; }, {"Compare/picture"}});
}

TEST(Updating, ViewsAndCountersAreDimmedUntilTheyAreOfTheChoice) {
    Desk& desk = Desk::clean();
    must(desk.player->click("tabs/Visualizers"));
    must(desk.player->wait());
    std::vector<std::string> shown;
    for (const WidgetRecord& record : desk.inspector->widgets().records())
        if (record.path.starts_with("Visualizers/") && record.kind == WidgetKind::canvas && shown.empty())
            shown.push_back(record.path);
    ASSERT_FALSE(shown.empty());
    for (const WidgetRecord& record : desk.inspector->widgets().records())
        if (record.path.starts_with("Counters/") && record.path.ends_with("/now") && shown.size() < 2)
            shown.push_back(record.path);
    expect_dimmed_until_made(desk, {"eye", [](Desk& at) { at.model().look_from({.dolly = .5}); }, shown});
}

TEST(Updating, ThePixelsPartsAreDimmedUntilTheyAreOfThePin) {
    Desk& desk = Desk::clean();
    desk.model().pin = glm::ivec2(48, 27);
    must(desk.player->click("tabs/Pixel"));
    must(desk.player->click("Pixel/parts/Steps"));
    must(desk.player->wait());
    std::vector<std::string> steps;
    for (const WidgetRecord& record : desk.inspector->widgets().records())
        if (record.path.starts_with("Pixel/steps/") && record.path.ends_with("/pass")) steps.push_back(record.path);
    ASSERT_FALSE(steps.empty());
    expect_dimmed_until_made(desk, {"pin", [](Desk& at) { at.model().pin = glm::ivec2(3, 3); }, {steps.front()}});
}

TEST(Updating, AnotherStepDimsThePictureOfTheStepBefore) {
    Desk& desk = Desk::clean();
    desk.model().pin = glm::ivec2(40, 20);
    desk.model().image = written_by_the_last_step(desk);
    must(desk.player->wait());
    const auto first = [](Desk& at) {
        const std::vector<PlanRow>& steps = at.replay()->steps;
        for (std::size_t i = 0; i < steps.size(); ++i)
            if (!steps[i].images.empty()) return void(at.model().image = {.name = steps[i].images.front(), .step = i});
    };
    expect_dimmed_until_made(desk, {"step", first, {"Image/picture", "Image/pinned"}});
}

TEST(Updating, OfVeilsWithinEachOtherOneWordIsShown) {
    Desk& desk = Desk::clean();
    must(desk.player->click("tabs/Compare"));
    desk.model().pin = glm::ivec2(40, 20);
    for (const char* mode : {"Wipe", "FLIP"}) {
        must(desk.player->click(fmt::format("Compare/{}", mode)));
        must(desk.player->wait());
        const HeldUp held(desk);
        desk.model().use(mode[0] == 'W' ? *must(find_technique("transparency/weighted"))
                                        : *must(find_technique("transparency/alpha_blend")));
        must(desk.player->frames(3));
        const auto& words = desk.inspector->widgets().words_on_veils();
        EXPECT_EQ(std::ranges::count(words, "updating display: A as recorded, B this replay"), 1) << mode;
    }
}

TEST(Updating, OtherShadersDimWhatTheOldOnesMadeUntilTheNewPictureIsThere) {
    Desk& desk = Desk::clean();
    const ShaderFolder shaders;
    desk.model().shaders = shaders.path();
    desk.model().pin = glm::ivec2(40, 20);
    shaders.change("passes/combine/hi_lo/film.comp", "sum / float(samples)", "sum * 0.5 / float(samples)");
    const auto reload = [](Desk& at) { must(at.player->key("r")); };
    expect_dimmed_until_made(desk, {"shaders", reload, {"Image/picture", "Image/pinned"}});
    shaders.change("passes/combine/hi_lo/film.comp", "void main", "void  main(; void main");
    expect_dimmed_until_made(desk, {"broken shader", reload, {"Image/picture", "Image/pinned"}});
    EXPECT_THAT(desk.said("top/shaders"), HasSubstr("the picture uses the shaders before the change"));
    shaders.restore("passes/combine/hi_lo/film.comp");
    must(desk.player->click("tabs/Compare"));
    must(desk.player->wait());
    expect_dimmed_until_made(desk, {"shaders of Compare", reload, {"Compare/picture", "Compare/differing"}});
    desk.model().shaders = ".";
}

/// The desk at a room of lights shaded in tiles, with the gallery in front and one of its views chosen.
Desk& at_view(const std::string& view) {
    Desk& desk = Desk::clean();
    desk.model().select_frame(frame_of("lights_room"));
    must(desk.player->wait());
    desk.model().use(*must(find_technique("lighting/tiled")));
    must(desk.player->click("tabs/Visualizers"));
    must(desk.player->click("Visualizers/lighting/tiled/" + view));
    must(desk.player->wait());
    return desk;
}
void move_eye(Desk& desk) { desk.model().look_from({.dolly = desk.model().edits().variant.eye.dolly + .5}); }

TEST(Updating, OverflowsAndSlicesAreDimmedUntilTheyAreOfTheChoice) {
    Desk& desk = at_view("overflow");
    std::vector<std::string> overflows;
    for (const WidgetRecord& record : desk.inspector->widgets().records())
        if (record.path.starts_with("Visualizers/selected/overflow/")) overflows.push_back(record.path);
    ASSERT_FALSE(overflows.empty());
    expect_dimmed_until_made(desk, {"overflow", move_eye, overflows});
    must(desk.player->click("Visualizers/lighting/tiled/LDS bytes"));
    must(desk.player->click("Visualizers/selected/slice"));
    must(desk.player->wait());
    ASSERT_TRUE(desk.model().image.made);
    expect_dimmed_until_made(desk, {"slice", move_eye, {"Image/picture"}});
    must(desk.player->type("Visualizers/selected/slice at", "512"));
    must(desk.player->wait());
    EXPECT_THAT(desk.said("Image/image"), HasSubstr("LDS bytes, 512"));
    EXPECT_EQ(desk.model().image.made->which, desk.model().image.which_made);
    must(desk.player->click("tabs/Techniques"));
    move_eye(desk);
    must(desk.player->wait());
    EXPECT_THAT(desk.widget("Image/picture").updating, HasSubstr("of an earlier replay")) << "nobody makes it anew";
    must(desk.player->click("tabs/Visualizers"));
    must(desk.player->wait());
    must(desk.player->click("Visualizers/selected/slice"));  // the desk is every test's
}

TEST(Updating, WavesOfOtherSettingsSaySo) {
    Desk& desk = at_view("tile modes");
    must(desk.player->choose("Visualizers/selected/waves/gpu", "bonaire"));
    must(desk.player->wait());
    EXPECT_EQ(desk.widget("Visualizers/selected/waves/mean").updating, "");
    move_eye(desk);
    must(desk.player->wait());
    EXPECT_EQ(desk.widget("Visualizers/selected/waves/mean").updating, "of other settings");
    must(desk.player->click("Visualizers/selected/waves/again"));
    must(desk.player->wait());
    EXPECT_EQ(desk.widget("Visualizers/selected/waves/mean").updating, "");
    must(desk.player->choose("Visualizers/selected/waves/gpu", "choose a GPU"));
}

TEST(Updating, ComparisonsAndViewsChangeNothingOfWhatTheLastChangeExecuted) {
    Desk& desk = Desk::clean();
    must(desk.player->click("tabs/Compare"));
    must(desk.player->choose("Compare/A/source", "as recorded"));
    must(desk.player->choose("Compare/B/source", "this replay"));
    must(desk.player->wait());
    // An eye that was nowhere before: every pass has to be executed, by whoever asks first.
    desk.model().look_from({.dolly = .123});
    must(desk.player->wait());
    const std::string executed = desk.said("Frame/executed");
    EXPECT_THAT(executed, testing::EndsWith(", 0 reused")) << executed;
    EXPECT_THAT(desk.inspector->log().back().text, HasSubstr(executed));
    desk.model().image = {.name = "lighting/tiled:LDS bytes"};
    must(desk.player->click("tabs/Image"));
    must(desk.player->wait());
    EXPECT_EQ(desk.said("Frame/executed"), executed);
}

TEST(Updating, AViewMoreChangesNothingOfWhatTheLastChangeExecuted) {
    Desk& desk = Desk::clean();
    use_weighted(desk);
    must(desk.player->wait());
    const std::string executed = desk.said("Frame/executed");
    EXPECT_THAT(desk.inspector->log().back().text, HasSubstr(executed)) << "log and panel count alike";
    const std::size_t lines = desk.inspector->log().size();
    show_color(desk);
    must(desk.player->wait());
    EXPECT_EQ(desk.said("Frame/executed"), executed);
    EXPECT_EQ(desk.inspector->log().size(), lines);
}

TEST(Updating, APictureOfAnEyeOfAMomentAgoIsDimmedLaterThanItsNumbers) {
    Desk& desk = Desk::clean();
    desk.model().pin = glm::ivec2(40, 20);
    must(desk.player->wait());
    const HeldUp held(desk);
    move_eye(desk);
    must(desk.player->frames(3));
    const auto& words = desk.inspector->widgets().words_on_veils();
    // "updating" lies over the range of the picture, "updating display" over the values, later over picture and values.
    EXPECT_EQ(std::ranges::count(words, "updating"), 0);
    EXPECT_EQ(std::ranges::count(words, "updating display"), 1);
    must(desk.player->frames(30));
    EXPECT_EQ(std::ranges::count(words, "updating"), 1);
    EXPECT_EQ(std::ranges::count(words, "updating display"), 1);
}

MadeOf seen_from(double dolly) { return {{.variant = {.eye = {.dolly = dolly}}, .outputs = {}}, 0}; }

TEST(EyeLag, APictureOfAMomentAgoPassesWhileTheEyeMovesAndOneOfLongerAgoDoesNot) {
    EyeLag lag;
    lag.note(seen_from(0), seen_from(0), 0);
    for (int frame = 1; frame <= 10; ++frame) lag.note(seen_from(frame), seen_from(std::max(0, frame - 3)), frame / 60.0);
    EXPECT_TRUE(lag.is_small()) << "50 ms late";
    lag.note(seen_from(10), seen_from(7), 20 / 60.0);
    EXPECT_TRUE(lag.is_small()) << "200 ms late";
    lag.note(seen_from(10), seen_from(7), 30 / 60.0);
    EXPECT_FALSE(lag.is_small()) << "370 ms late";
    lag.note(seen_from(10), seen_from(10), 31 / 60.0);
    EXPECT_TRUE(lag.is_small());
}

TEST(EyeLag, WhatIsDimmedStaysSoWhilePicturesComeLate) {
    EyeLag lag;
    // A picture every 150 ms: each is between 150 and 300 ms late.
    for (int frame = 0; frame <= 60; ++frame) {
        lag.note(seen_from(frame), seen_from(std::max(0, frame / 9 * 9 - 9)), frame / 60.0);
        if (frame >= 27) {
            EXPECT_FALSE(lag.is_small()) << frame;
        }
    }
}

TEST(EyeLag, AnythingButTheEyeIsNeverSmall) {
    EyeLag lag;
    MadeOf other = seen_from(1);
    other.request.variant.frame = 1;
    lag.note(seen_from(0), seen_from(0), 0);
    lag.note(other, seen_from(0), .01);
    EXPECT_FALSE(lag.is_small());
    MadeOf shaders = seen_from(0);
    shaders.shaders = 1;
    lag.note(shaders, seen_from(0), .02);
    EXPECT_FALSE(lag.is_small());
}

}  // namespace
}  // namespace strata::ui
