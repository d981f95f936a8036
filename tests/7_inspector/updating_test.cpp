// Nothing is shown undimmed under a label that is not its own: every selector is changed while the session is held up.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"

namespace strata::ui {
namespace {

using testing::HasSubstr;

/// The session does nothing else until this goes.
class HeldUp {
public:
    explicit HeldUp(Desk& desk) {
        job_ = desk.inspector->replayer().start<int>(
            [this](Session&, ui::Progress&) -> Result<int> {
                while (!done_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
                return 0;
            },
            Yields::between_steps);
    }
    HeldUp(const HeldUp&) = delete;
    ~HeldUp() {
        done_ = true;
        while (!job_->result()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

private:
    std::atomic<bool> done_ = false;
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

TEST(Updating, EverySelectorDimsWhatWasMadeBeforeIt) {
    Desk& desk = Desk::clean();
    const std::vector<std::string> image = {"Image/picture", "Image/range", "Image/pinned"};
    const std::vector<std::string> all = {"Image/picture", "Image/pinned"};
    const Selector selectors[] = {
        {"technique", use_weighted, image},
        {"frame", [](Desk& at) { at.model().select_frame(1); }, image},
        {"eye", [](Desk& at) { at.model().look_from({.dolly = .5}); }, all},
        {"samples", [](Desk& at) { at.model().set_samples(4); }, all},
        {"image", show_color, image},
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
        if (record.path.starts_with("Pixel/steps/") && record.path.ends_with("/act")) steps.push_back(record.path);
    ASSERT_FALSE(steps.empty());
    expect_dimmed_until_made(desk, {"pin", [](Desk& at) { at.model().pin = glm::ivec2(3, 3); }, {steps.front()}});
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

}  // namespace
}  // namespace strata::ui
