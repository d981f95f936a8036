#include "ui/window/theme.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "ui/window/keys.h"

extern "C" {
extern const unsigned char strata_font[], strata_font_end[];
}

namespace strata::ui {
namespace {

constexpr float font_pixels = 15;

ImVec4 rgb(std::uint32_t hex, float alpha = 1) {
    return {static_cast<float>(hex >> 16 & 255) / 255, static_cast<float>(hex >> 8 & 255) / 255,
            static_cast<float>(hex & 255) / 255, alpha};
}

void load_font(ImGuiIO& io) {
    // Latin, Greek, arrows, mathematical signs, geometric shapes: what panels use.
    static const ImWchar ranges[] = {0x20, 0xff, 0x370, 0x3ff, 0x2010, 0x2044, 0x2190, 0x22ff, 0x25a0, 0x27bf, 0};
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;
    config.PixelSnapH = true;
    const auto bytes = static_cast<int>(strata_font_end - strata_font);
    io.Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(strata_font), bytes, font_pixels, &config, ranges);
}

void set_shapes(ImGuiStyle& style) {
    style.WindowPadding = {8, 8};
    style.FramePadding = {7, 3};
    style.ItemSpacing = {7, 5};
    style.ItemInnerSpacing = {5, 4};
    style.CellPadding = {5, 2};
    style.IndentSpacing = 15;
    style.ScrollbarSize = 12;
    style.GrabMinSize = 9;
    style.WindowRounding = 0;
    style.ChildRounding = 0;
    style.FrameRounding = 3;
    style.PopupRounding = 4;
    style.GrabRounding = 3;
    style.TabRounding = 3;
    style.ScrollbarRounding = 6;
    style.WindowBorderSize = 0;
    style.ChildBorderSize = 0;
    style.PopupBorderSize = 1;
    style.WindowMenuButtonPosition = ImGuiDir_None;
}

void set_colors(ImGuiStyle& style) {
    struct Row {
        ImGuiCol what;
        ImVec4 color;
    };
    const ImVec4 accent = palette().accent;
    const auto tinted = [&](float alpha) { return ImVec4(accent.x, accent.y, accent.z, alpha); };
    const Row rows[] = {
        {ImGuiCol_Text, palette().text},
        {ImGuiCol_TextDisabled, palette().dim},
        {ImGuiCol_WindowBg, rgb(0x14161a)},
        {ImGuiCol_ChildBg, rgb(0x1b1e24)},
        {ImGuiCol_PopupBg, rgb(0x22262e)},
        {ImGuiCol_Border, rgb(0x383e4a)},
        {ImGuiCol_FrameBg, rgb(0x282d37)},
        {ImGuiCol_FrameBgHovered, rgb(0x323945)},
        {ImGuiCol_FrameBgActive, rgb(0x3a4352)},
        {ImGuiCol_TitleBg, rgb(0x14161a)},
        {ImGuiCol_TitleBgActive, rgb(0x22262e)},
        {ImGuiCol_ScrollbarBg, rgb(0x1b1e24, 0)},
        {ImGuiCol_ScrollbarGrab, rgb(0x3a4150)},
        {ImGuiCol_ScrollbarGrabHovered, rgb(0x4a5364)},
        {ImGuiCol_ScrollbarGrabActive, rgb(0x596479)},
        {ImGuiCol_CheckMark, accent},
        {ImGuiCol_SliderGrab, tinted(.5f)},  // a number may stand on it
        {ImGuiCol_SliderGrabActive, accent},
        {ImGuiCol_Button, rgb(0x2c323d)},
        {ImGuiCol_ButtonHovered, rgb(0x3a4352)},
        {ImGuiCol_ButtonActive, tinted(.6f)},
        {ImGuiCol_Header, tinted(.22f)},
        {ImGuiCol_HeaderHovered, rgb(0xffffff, .06f)},
        {ImGuiCol_HeaderActive, tinted(.35f)},
        {ImGuiCol_Separator, palette().line},
        {ImGuiCol_SeparatorHovered, tinted(.6f)},
        {ImGuiCol_SeparatorActive, accent},
        {ImGuiCol_Tab, rgb(0x14161a, 0)},
        {ImGuiCol_TabHovered, rgb(0x323945)},
        {ImGuiCol_TabActive, rgb(0x2a303b)},
        {ImGuiCol_TabUnfocused, rgb(0x14161a, 0)},
        {ImGuiCol_TabUnfocusedActive, rgb(0x2a303b)},
        {ImGuiCol_PlotHistogram, accent},
        {ImGuiCol_TableHeaderBg, rgb(0x1f232a)},
        {ImGuiCol_TableBorderLight, rgb(0x2a2f38)},
        {ImGuiCol_TableBorderStrong, rgb(0x383e4a)},
        {ImGuiCol_TableRowBgAlt, rgb(0xffffff, .02f)},
        {ImGuiCol_TextSelectedBg, tinted(.35f)},
        {ImGuiCol_NavHighlight, tinted(0)},
        {ImGuiCol_ModalWindowDimBg, rgb(0x000000, .5f)},
    };
    for (const Row& row : rows) style.Colors[row.what] = row.color;
}

}  // namespace

const Palette& palette() {
    static const Palette colors{.accent = rgb(0x58a6e8),
                                .good = rgb(0x7fc98b),
                                .warning = rgb(0xe3b25c),
                                .bad = rgb(0xef6b6b),
                                .dim = rgb(0x868e9c),
                                .text = rgb(0xd6dae1),
                                .line = rgb(0x0f1114)};
    return colors;
}

ImU32 packed(const ImVec4& color, float alpha) {
    return ImGui::ColorConvertFloat4ToU32({color.x, color.y, color.z, color.w * alpha});
}

ImVec4 color_of_stage(std::size_t index) {
    // The golden angle keeps neighbors apart whatever their count; from the eighth on hues come near to the first ones.
    const float hue = std::fmod(.58f + static_cast<float>(index) * .381966f, 1.0f);
    const bool repeats = index >= 7;
    ImVec4 color(0, 0, 0, 1);
    ImGui::ColorConvertHSVtoRGB(hue, repeats ? .7f : .45f, repeats ? 1.0f : .82f, color.x, color.y, color.z);
    return color;
}

Context::Context() : context_(ImGui::CreateContext()) {
    ImGui::SetCurrentContext(context_);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.ConfigInputTextCursorBlink = false;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    map_keys(io);
    load_font(io);
    set_shapes(ImGui::GetStyle());
    set_colors(ImGui::GetStyle());
}

Context::~Context() { ImGui::DestroyContext(context_); }

}  // namespace strata::ui
