#include "ui/picture/go_to_pixel.h"

#include <charconv>
#include <string_view>

#include "ui/window/keys.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

// A pixel that somebody asks for by number is looked at closely.
constexpr double readable_zoom = 8;

}  // namespace

std::optional<glm::ivec2> pixel_of(std::string_view text) {
    glm::ivec2 pixel(0);
    const char* at = text.data();
    const char* const end = at + text.size();
    const auto skip = [&](std::string_view between) {
        while (at != end && between.find(*at) != between.npos) ++at;
    };
    for (int i = 0; i < 2; ++i) {
        skip(i == 0 ? " " : " ,x");
        const auto [rest, problem] = std::from_chars(at, end, pixel[i]);
        if (problem != std::errc()) return {};
        at = rest;
    }
    skip(" ");
    return at == end ? std::optional(pixel) : std::nullopt;
}

void GoToPixel::open() {
    is_open_ = takes_focus_ = true;
    text_.clear();
}

void GoToPixel::draw(Model& model, Widgets& widgets, glm::uvec2 extent) {
    if (!is_open_) return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x / 2, size.y / 4}, ImGuiCond_Always, {.5f, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {14, 10});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyle().Colors[ImGuiCol_PopupBg]);
    ImGui::Begin("go to", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    ask(model, widgets, extent);
    if (ImGui::IsKeyPressed(chord_of("escape")->key)) is_open_ = false;
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

void GoToPixel::ask(Model& model, Widgets& widgets, glm::uvec2 extent) {
    const auto scope = widgets.in("go to");
    widgets.text("what", "Go to pixel", &palette().dim);
    ImGui::SameLine();
    if (takes_focus_) ImGui::SetKeyboardFocusHere();
    takes_focus_ = false;
    ImGui::SetNextItemWidth(110);
    if (const auto typed = widgets.input("pixel", text_, "x y")) text_ = *typed;
    const bool entered = ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(chord_of("enter")->key);
    const auto pixel = pixel_of(text_);
    const bool is_there =
        pixel && glm::all(glm::greaterThanEqual(*pixel, glm::ivec2(0))) && glm::all(glm::lessThan(*pixel, glm::ivec2(extent)));
    if (!text_.empty() && !is_there)
        widgets.text("refused", fmt::format("two whole numbers below {} and {}", extent.x, extent.y), &palette().warning);
    if (entered && is_there) {
        model.pin = *pixel;
        model.view = {std::max(model.view.zoom, readable_zoom), pixel->x + .5, pixel->y + .5};
        is_open_ = false;
    }
}

}  // namespace strata::ui
