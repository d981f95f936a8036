#include "ui/picture/picture_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/difference/picture.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr double least_zoom = 1.0 / 16, most_zoom = 256;
constexpr double grid_zoom = 8, numbers_zoom = 44;

/// As large as fits; whole pixels per texel from two on, so that all texels are of one size.
double zoom_that_fits(ImVec2 size, const Texels& texels) {
    const double zoom = std::min(double{size.x} / texels.width, double{size.y} / texels.height);
    return zoom >= 2 ? std::floor(zoom) : std::max(zoom, least_zoom);
}

/// The texels that are on the screen.
struct Range {
    glm::ivec2 from, to;
};
Range visible(const Placement& placement) {
    const glm::ivec2 first = placement.texel_at(placement.from), last = placement.texel_at(placement.to);
    const glm::ivec2 most(static_cast<int>(placement.width), static_cast<int>(placement.height));
    return {glm::clamp(first, glm::ivec2(0), most), glm::clamp(last + 1, glm::ivec2(0), most)};
}

void draw_numbers(const Placement& placement, const PictureInfo& picture, Range range) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::uint32_t channels = picture.channels();
    const float line = ImGui::GetTextLineHeight();
    constexpr std::array<ImU32, 4> colors = {IM_COL32(255, 150, 150, 255), IM_COL32(150, 255, 150, 255),
                                             IM_COL32(160, 190, 255, 255), IM_COL32(230, 230, 230, 255)};
    for (int y = range.from.y; y < range.to.y; ++y)
        for (int x = range.from.x; x < range.to.x; ++x) {
            const glm::dvec4 value = picture.at({x, y});
            const ImVec2 middle = placement.on_screen(x + .5, y + .5);
            for (std::uint32_t c = 0; c < channels; ++c) {
                const std::string text = fmt::format("{:.3g}", value[static_cast<int>(c)]);
                const float top = middle.y + (static_cast<float>(c) - static_cast<float>(channels) / 2) * line;
                const ImVec2 at(std::round(middle.x - ImGui::CalcTextSize(text.c_str()).x / 2), std::round(top));
                list.AddText({at.x + 1, at.y + 1}, IM_COL32(0, 0, 0, 200), text.c_str());
                list.AddText(at, channels == 1 ? colors[3] : colors[c], text.c_str());
            }
        }
}

}  // namespace

ImVec2 Placement::on_screen(double x, double y) const {
    return {corner.x + static_cast<float>(x * zoom), corner.y + static_cast<float>(y * zoom)};
}

glm::ivec2 Placement::texel_at(ImVec2 point) const {
    // Without a mouse Dear ImGui says -FLT_MAX, which is no int.
    const auto whole = [&](float pixels) { return static_cast<int>(std::clamp(std::floor(double{pixels} / zoom), -1e9, 1e9)); };
    return {whole(point.x - corner.x), whole(point.y - corner.y)};
}

ImVec2 mouse_point() {
    const ImVec2 corner = ImGui::GetIO().MousePos;
    return {corner.x + .5f, corner.y + .5f};
}

Placement place(const PictureView& view, ImVec2 from, ImVec2 size, const Texels& texels) {
    Placement placement{.from = from, .to = {from.x + size.x, from.y + size.y}, .width = texels.width, .height = texels.height};
    const bool fits = view.zoom == 0;
    placement.zoom = fits ? zoom_that_fits(size, texels) : view.zoom;
    const double x = fits ? texels.width / 2.0 : view.center_x, y = fits ? texels.height / 2.0 : view.center_y;
    placement.corner = {std::round(from.x + size.x / 2 - static_cast<float>(x * placement.zoom)),
                        std::round(from.y + size.y / 2 - static_cast<float>(y * placement.zoom))};
    return placement;
}

namespace {

/// The view that shows the same as the placement.
PictureView view_of(const Placement& placement) {
    const ImVec2 middle((placement.from.x + placement.to.x) / 2, (placement.from.y + placement.to.y) / 2);
    return {placement.zoom, double{middle.x - placement.corner.x} / placement.zoom,
            double{middle.y - placement.corner.y} / placement.zoom};
}

/// Zooms so that the texel under the point stays there.
PictureView zoomed(const Placement& placement, ImVec2 point, double factor) {
    PictureView view = view_of(placement);
    const double zoom = std::clamp(placement.zoom * factor, least_zoom, most_zoom);
    const double from_middle_x = double{point.x - (placement.from.x + placement.to.x) / 2},
                 from_middle_y = double{point.y - (placement.from.y + placement.to.y) / 2};
    view.center_x += from_middle_x / placement.zoom - from_middle_x / zoom;
    view.center_y += from_middle_y / placement.zoom - from_middle_y / zoom;
    view.zoom = zoom;
    return view;
}

}  // namespace

void move_by_mouse(PictureView& view, const Placement& placement) {
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemHovered() && io.MouseWheel != 0)
        view = zoomed(placement, mouse_point(), std::pow(1.25, double{io.MouseWheel}));
    for (const ImGuiMouseButton button : {ImGuiMouseButton_Left, ImGuiMouseButton_Middle}) {
        if (!ImGui::IsItemActive() || !ImGui::IsMouseDragging(button)) continue;
        const ImVec2 by = ImGui::GetMouseDragDelta(button);  // with what it took to become a drag
        ImGui::ResetMouseDragDelta(button);
        if (by.x == 0 && by.y == 0) continue;
        view = view_of(placement);
        view.center_x -= double{by.x} / placement.zoom;
        view.center_y -= double{by.y} / placement.zoom;
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) view = {};
}

void zoom_by(PictureView& view, const Placement& placement, double factor) {
    view = zoomed(placement, {(placement.from.x + placement.to.x) / 2, (placement.from.y + placement.to.y) / 2}, factor);
}

void draw_picture(ImguiLayer& layer, const Placement& placement, TextureId texture, const Look& look, const Columns& columns) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 to = placement.on_screen(placement.width, placement.height);
    list.PushClipRect({std::max(placement.from.x, columns.from), placement.from.y},
                      {std::min(placement.to.x, columns.to), placement.to.y}, true);
    list.AddImage(layer.shown(texture, look), placement.corner, to);
    list.PopClipRect();
}

void draw_details(const Placement& placement, const PictureInfo& picture) {
    if (placement.zoom < grid_zoom) return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(placement.from, placement.to, true);
    const Range range = visible(placement);
    const ImU32 line = IM_COL32(128, 128, 128, placement.zoom >= numbers_zoom ? 120 : 50);
    for (int x = range.from.x; x <= range.to.x; ++x)
        list.AddLine(placement.on_screen(x, range.from.y), placement.on_screen(x, range.to.y), line);
    for (int y = range.from.y; y <= range.to.y; ++y)
        list.AddLine(placement.on_screen(range.from.x, y), placement.on_screen(range.to.x, y), line);
    const bool fit = placement.zoom >= numbers_zoom && placement.zoom >= double{ImGui::GetTextLineHeight()} * picture.channels();
    if (fit) draw_numbers(placement, picture, range);
    list.PopClipRect();
}

bool shows_numbers(const Placement& placement) { return placement.zoom >= numbers_zoom; }

void draw_pin(const Placement& placement, glm::ivec2 pin) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(placement.from, placement.to, true);
    ImVec2 from = placement.on_screen(pin.x, pin.y), to = placement.on_screen(pin.x + 1, pin.y + 1);
    from = {from.x - 1, from.y - 1};
    to = {std::max(to.x, from.x + 4) + 1, std::max(to.y, from.y + 4) + 1};
    list.AddRect({from.x - 1, from.y - 1}, {to.x + 1, to.y + 1}, IM_COL32(0, 0, 0, 220), 0, 0, 3);
    list.AddRect(from, to, packed(palette().accent));
    const ImVec2 middle((from.x + to.x) / 2, (from.y + to.y) / 2);
    constexpr float arm = 9;
    for (const ImVec2 side : {ImVec2(-1, 0), ImVec2(1, 0), ImVec2(0, -1), ImVec2(0, 1)}) {
        const float half = side.x != 0 ? (to.x - from.x) / 2 : (to.y - from.y) / 2;
        list.AddLine({middle.x + side.x * (half + 3), middle.y + side.y * (half + 3)},
                     {middle.x + side.x * (half + arm), middle.y + side.y * (half + arm)}, packed(palette().accent), 1.5f);
    }
    list.PopClipRect();
}

std::string values_text(const PictureInfo& picture, glm::ivec2 texel) {
    if (!picture.contains(texel)) return {};
    const glm::dvec4 value = picture.at(texel);
    const bool whole = row(picture.image->shape.format).kind == FormatKind::integer;
    std::string text;
    for (std::uint32_t c = 0; c < picture.channels(); ++c)
        text += whole ? fmt::format("{}{:.0f}", c ? "  " : "", value[static_cast<int>(c)])
                      : fmt::format("{}{:.5g}", c ? "  " : "", value[static_cast<int>(c)]);
    return text;
}

const DebugView* find_view(const std::string& name) {
    const std::size_t colon = name.find(':');
    const auto technique = find_technique(name.substr(0, colon));
    if (colon == std::string::npos || !technique) return nullptr;
    const auto found = std::ranges::find((*technique)->views, name.substr(colon + 1), &DebugView::name);
    return found == (*technique)->views.end() ? nullptr : &*found;
}

Look default_look(const std::string& name, const PictureInfo& picture) {
    Look look;
    if (picture.channels() == 1) look.channels = Channels::red;
    const FrameImageRow* known = find_frame_image(name);
    if (known && (known->content == Content::display || known->content == Content::radiance)) return look;
    look.curve = Curve::raw;
    if (const DebugView* view = find_view(name)) {
        look.black = static_cast<float>(view->low);
        look.white = static_cast<float>(view->high);
        return look;
    }
    const auto [black, white] = scale_ends(picture.bulk.low, picture.bulk.high);
    look.black = static_cast<float>(black);
    look.white = static_cast<float>(white);
    return look;
}

}  // namespace strata::ui
