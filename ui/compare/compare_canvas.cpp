#include "ui/compare/compare_canvas.h"

#include <algorithm>
#include <cmath>

#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr float reach = 6;              // pixels to either side of the divider that take it
constexpr double zoom_of_a_visit = 16;  // at which a texel is easy to see among its neighbors

void draw_background(ImVec2 from, ImVec2 size) {
    ImGui::GetWindowDrawList()->AddRectFilled(from, {from.x + size.x, from.y + size.y}, IM_COL32(14, 15, 18, 255));
}

/// In an upper corner, where there is room.
void draw_label(const std::string& label, ImVec2 at, float width) {
    if (label.empty() || width < 70) return;
    const ImVec2 text = ImGui::CalcTextSize(label.c_str(), nullptr, false, std::max(width - 24, 20.0f));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x + 6, at.y + 6}, {at.x + text.x + 18, at.y + text.y + 10}, IM_COL32(20, 22, 27, 200), 4);
    list.AddText(nullptr, 0, {at.x + 12, at.y + 8}, packed(palette().text), label.c_str(), nullptr, std::max(width - 24, 20.0f));
}

void draw_divider(float x, ImVec2 from, ImVec2 to, bool held) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = (from.y + to.y) / 2;
    list.AddLine({x, from.y}, {x, to.y}, IM_COL32(0, 0, 0, 160), 3);
    list.AddLine({x, from.y}, {x, to.y}, packed(palette().accent), held ? 2.0f : 1.0f);
    list.AddRectFilled({x - 4, middle - 14}, {x + 4, middle + 14}, packed(palette().accent), 3);
    for (const float y : {-5.0f, 0.0f, 5.0f}) list.AddLine({x - 2, middle + y}, {x + 2, middle + y}, IM_COL32(10, 12, 15, 255));
}

}  // namespace

void CompareCanvas::draw(const ComparedView& view, Model& model, Services& services) {
    was_under_ = std::exchange(under_, std::nullopt);
    const Cell whole{"picture", view.size};
    switch (view.mode) {
        case CompareMode::wipe:
            return draw_wipe(view, model, services);
        case CompareMode::side_by_side: {
            constexpr float gap = 4;
            const ImVec2 half(std::max((view.size.x - gap) / 2, 10.0f), view.size.y);
            draw_one({"picture A", half}, view.a, model, services);
            ImGui::SameLine(0, gap);
            return draw_one({"picture B", half}, view.b, model, services);
        }
        case CompareMode::flip:
            return draw_one(whole, shows_b_ ? view.b : view.a, model, services);
        case CompareMode::difference:
        case CompareMode::relative:
        case CompareMode::flip_map:
            return draw_one(whole, view.map, model, services);
    }
}

void CompareCanvas::draw_one(const Cell& cell, const CanvasPicture& picture, Model& model, Services& services) {
    services.widgets.canvas(cell.label, cell.size, picture.label);
    const ImVec2 from = ImGui::GetItemRectMin();
    draw_background(from, cell.size);
    if (picture.info) {
        placement_ = place(model.view, from, cell.size, picture.info->texels);
        take_mouse(model, *picture.info);
        draw_picture(services.layer, placement_, picture.texture, picture.look);
        draw_details(placement_, *picture.info);
        draw_marks(model, *picture.info);
    }
    draw_label(picture.label, from, cell.size.x);
}

void CompareCanvas::draw_wipe(const ComparedView& view, Model& model, Services& services) {
    services.widgets.canvas("picture", view.size, fmt::format("A {:.0f} %, then B", divider_ * 100));
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    draw_background(from, view.size);
    const bool at_divider = pull_divider(from, view.size.x);
    const float x = std::round(from.x + divider_ * view.size.x);
    for (const CanvasPicture* each : {&view.b, &view.a}) {
        if (!each->info) continue;
        placement_ = place(model.view, from, view.size, each->info->texels);
        const Columns columns = each == &view.a ? Columns{.to = x} : Columns{.from = x};
        // The hand is A's where both are of one size, and they mostly are.
        if (each == &view.a && !at_divider) take_mouse(model, *each->info);
        draw_picture(services.layer, placement_, each->texture, each->look, columns);
        ImGui::GetWindowDrawList()->PushClipRect({std::max(from.x, columns.from), from.y}, {std::min(to.x, columns.to), to.y},
                                                 true);
        draw_details(placement_, *each->info);
        ImGui::GetWindowDrawList()->PopClipRect();
    }
    if (view.a.info) draw_marks(model, *view.a.info);
    draw_divider(x, from, to, at_divider);
    draw_label(view.a.label, from, x - from.x);
    const float width = to.x - x;
    const float text = ImGui::CalcTextSize(view.b.label.c_str(), nullptr, false, std::max(width - 24, 20.0f)).x;
    draw_label(view.b.label, {std::max(x, to.x - text - 24), from.y}, width);
}

bool CompareCanvas::pull_divider(ImVec2 from, float width) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool is_near = ImGui::IsItemHovered() && std::abs(io.MousePos.x - (from.x + divider_ * width)) <= reach;
    if (is_near && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) is_pulled_ = true;
    const bool was_pulled = is_pulled_;
    if (is_pulled_) divider_ = std::clamp((io.MousePos.x - from.x) / width, 0.0f, 1.0f);
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) is_pulled_ = false;
    const bool takes = was_pulled || (is_near && !ImGui::IsMouseDown(ImGuiMouseButton_Left));
    if (takes) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    return takes;
}

void CompareCanvas::take_mouse(Model& model, const PictureInfo& picture) {
    const glm::ivec2 texel = placement_.texel_at(mouse_point());
    if (ImGui::IsItemHovered() && picture.contains(texel)) under_ = texel;
    const bool was_click = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
                           ImGui::GetIO().MouseDragMaxDistanceSqr[0] < 9;
    if (was_click && picture.contains(texel)) model.pin = texel;
    if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) model.pin.reset();
    move_by_mouse(model.view, placement_);
    const ImVec2 size(placement_.to.x - placement_.from.x, placement_.to.y - placement_.from.y);
    placement_ = place(model.view, placement_.from, size, picture.texels);
}

/// The pinned texel, and beside the picture under the mouse the same place in the other.
void CompareCanvas::draw_marks(const Model& model, const PictureInfo& picture) const {
    if (model.pin && picture.contains(*model.pin)) draw_pin(placement_, *model.pin);
    const std::optional<glm::ivec2>& at = under_ ? under_ : was_under_;
    if (!at || !picture.contains(*at) || ImGui::IsItemHovered()) return;
    const ImVec2 middle = placement_.on_screen(at->x + .5, at->y + .5);
    ImGui::GetWindowDrawList()->AddCircle(middle, std::max(4.0f, static_cast<float>(placement_.zoom)),
                                          packed(palette().text, .8f), 0, 1.5f);
}

void CompareCanvas::go_to(PictureView& view, glm::ivec2 texel) const {
    view = {std::max(placement_.zoom, zoom_of_a_visit), texel.x + .5, texel.y + .5};
}

}  // namespace strata::ui
