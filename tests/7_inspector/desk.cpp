#include "tests/7_inspector/desk.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/scenarios.h"
#include "tests/support/session.h"

namespace strata::ui {
namespace {

constexpr std::uint32_t width = 96, height = 54;

/// The frame that most tests are about comes first: few steps, of which every one takes long enough to be seen on the timeline.
std::vector<const Scenario*> in_order() {
    std::vector<const Scenario*> order = {must(find_scenario("three_cards"))};
    for (const Scenario& scenario : scenarios())
        if (&scenario != order.front()) order.push_back(&scenario);
    return order;
}

std::unique_ptr<Desk> the_desk;

/// At the end of the process the desk would be destroyed after parts of the driver, on which a replay may still run.
class ClosesTheDesk : public testing::Environment {
public:
    void TearDown() override { the_desk.reset(); }
};
[[maybe_unused]] testing::Environment* const closes = testing::AddGlobalTestEnvironment(new ClosesTheDesk);

}  // namespace

std::vector<Frame> small_scenarios() {
    std::vector<Frame> frames;
    for (const Scenario* scenario : in_order()) frames.push_back(scenario->build(0, {.width = width, .height = height}));
    return frames;
}

std::size_t frame_of(std::string_view scenario) {
    const std::vector<const Scenario*> order = in_order();
    return static_cast<std::size_t>(std::ranges::find(order, scenario, &Scenario::name) - order.begin());
}

Desk::Desk() : layer(must(ImguiLayer::headless({.validation = true}))) {
    Model shown("scenarios.strata", {.validation = true}, {});
    shown.program = STRATA_BINARY_DIR "/strata";  // this program compiles nothing in a process of its own
    inspector = std::make_unique<Inspector>(
        *layer, std::move(shown), [] { return Session::open(small_scenarios(), {.validation = true}); }, Layout());
    player = std::make_unique<Player>(*inspector, *layer, ImVec2(1280, 800));
}

Desk& Desk::clean() {
    if (!the_desk) the_desk.reset(new Desk);
    Desk& desk = *the_desk;
    Model& model = desk.model();
    model.image = {};
    model.step.reset();
    model.draw.reset();
    model.outline.reset();
    model.pin.reset();
    model.view = {};
    model.looks.clear();
    if (model.is_known()) model.reset_all();
    model.select_frame(0);
    must(desk.player->wait());
    desk.bring_first_tabs_to_the_front();
    ImGui::GetIO().MousePos = {-1000, -1000};
    must(desk.player->wait());
    return desk;
}

void Desk::bring_first_tabs_to_the_front() {
    for (const Area area : {Area::left, Area::center, Area::right, Area::bottom}) {
        const auto first = std::ranges::find(panels(), area, &PanelRow::area);
        const std::string tab = fmt::format("tabs/{}", first->name);
        if (widget(tab).value != "selected") must(player->click(tab));
    }
}

const WidgetRecord& Desk::widget(std::string_view path) {
    const auto& records = inspector->widgets().records();
    const auto found = std::ranges::find(records, path, &WidgetRecord::path);
    if (found == records.end()) throw std::runtime_error(fmt::format("there is no widget {}", path));
    return *found;
}

std::string Desk::said(std::string_view path) { return widget(path).value; }

void Desk::expect_no_conflicts() {
    must(player->frames(1));
    must(inspector->render());
    EXPECT_THAT(inspector->widgets().conflicts(), testing::IsEmpty());
    EXPECT_THAT(layer->take_messages(), testing::IsEmpty());
}

}  // namespace strata::ui
