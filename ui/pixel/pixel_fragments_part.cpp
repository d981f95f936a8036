// The transparent fragments of the pinned pixel, nearest first.
#include <algorithm>

#include "replay/plural.h"
#include "ui/pixel/pixel_fragments.h"
#include "ui/pixel/pixel_part.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

std::string rgb(const glm::dvec3& v) { return fmt::format("{:.4g}  {:.4g}  {:.4g}", v.x, v.y, v.z); }
double mean(const glm::dvec3& v) { return (v.x + v.y + v.z) / 3; }

/// All that there is to say of a fragment.
std::string help_of(const PixelFragment& row) {
    const Fragment& f = row.fragment;
    std::string text = fmt::format(
        "{}\nview depth {:.6g} m, triangle {} in submission order\nalpha {:.5f}\nscattered radiance p, premultiplied {}\n"
        "emitted radiance e {}\nlets through t {}\nbefore it T {}\nadds T (p + e) {}",
        row.drawn_by, f.depth, f.submission, f.alpha, rgb(f.color), rgb(f.emission), rgb(f.transmittance), rgb(row.in_front),
        rgb(row.in_front * (f.color + f.emission)));
    if (f.layer > 0) text += fmt::format("\nof interface layer {}", f.layer);
    if (f.soft_fade > 0) text += fmt::format("\nfades over {:.3g} m before what is opaque", f.soft_fade);
    if (f.distortion != glm::dvec2(0)) text += fmt::format("\ndistorts by {:.4g} {:.4g} of uv", f.distortion.x, f.distortion.y);
    return text;
}

class FragmentsPart final : public PixelPart {
public:
    void draw(Model& model, Services& services, const Replay& replay) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("fragments");
        const PixelQuestion asked{with_display_alone(replay.request), glm::uvec2(*model.pin)};
        asked_.ask(services.replayer, asked, fragments_of);
        draw_state_of(widgets, asked_);
        const auto* samples = asked_.answer();
        if (!samples || samples->empty()) return;
        const auto updating = widgets.updating(updating_word(asked_, asked, model, services));
        sample_ = std::min(sample_, samples->size() - 1);
        if (samples->size() > 1) {
            const SliderRange range{.high = static_cast<double>(samples->size() - 1), .whole = true};
            ImGui::SetNextItemWidth(-60);
            const auto set = widgets.slider("sample", static_cast<double>(sample_), range);
            if (set) sample_ = static_cast<std::size_t>(*set);
            ImGui::SameLine();
            ImGui::TextDisabled("sample");
        }
        const SampleFragments& sample = (*samples)[sample_];
        draw_sum(widgets, sample);
        if (!sample.fragments.empty()) draw_table(widgets, sample);
    }
    void withdraw() override { asked_.withdraw(); }
    bool is_busy() const override { return asked_.progress() != nullptr; }

private:
    static void draw_sum(Widgets& widgets, const SampleFragments& sample) {
        if (sample.fragments.empty()) {
            widgets.text("count", "no transparent fragment here", &palette().dim);
            return;
        }
        widgets.text("count", fmt::format("{}, nearest first", plural(sample.fragments.size(), "fragment")));
        widgets.value("let through", fmt::format("T {}", rgb(sample.through)));
        widgets.help("the share of the light behind all of them that arrives, per channel, by the exact order");
        widgets.value("added", rgb(sample.light));
        widgets.help("radiance that they add, by the exact order");
        if (!sample.undecided) return;
        ImGui::PushTextWrapPos(0);
        widgets.text("undecided", "rounding decides which fragments exist here: the device may see others", &palette().warning);
        ImGui::PopTextWrapPos();
    }

    static void draw_table(Widgets& widgets, const SampleFragments& sample) {
        constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollX |
                                          ImGuiTableFlags_ScrollY | ImGuiTableFlags_NoPadOuterX;
        if (!ImGui::BeginTable("list", 6, flags)) return;
        for (const char* column : {"#", "depth m", "p + e", "alpha", "T before", "drawn by"}) ImGui::TableSetupColumn(column);
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableHeadersRow();
        for (std::size_t i = 0; i < sample.fragments.size(); ++i) draw_row(widgets, sample.fragments[i], i + 1);
        ImGui::EndTable();
    }

    static void draw_row(Widgets& widgets, const PixelFragment& row, std::size_t number) {
        const Fragment& fragment = row.fragment;
        const auto scope = widgets.in(fmt::format("{}", number));
        ImGui::TableNextRow();
        const auto cell = [&](std::string_view label, std::string_view text, const ImVec4& color) {
            ImGui::TableNextColumn();
            if (label == "color") draw_swatch(fragment.color + fragment.emission);
            widgets.text(label, text, &color);
            if (ImGui::IsItemHovered()) widgets.help(help_of(row));
        };
        cell("number", fmt::format("{}", number), palette().dim);
        cell("depth", fmt::format("{:.5g}", fragment.depth), palette().text);
        cell("color", fmt::format("{:.3g}", mean(fragment.color + fragment.emission)), palette().text);
        cell("alpha", fmt::format("{:.4f}", fragment.alpha), palette().text);
        // What hardly anything arrives of matters little.
        cell("before", fmt::format("{:.4f}", mean(row.in_front)), mean(row.in_front) < .01 ? palette().dim : palette().text);
        cell("drawn by", row.drawn_by, palette().text);
    }

    LiveQuery<PixelQuestion, std::vector<SampleFragments>> asked_;
    std::size_t sample_ = 0;
};

}  // namespace

std::unique_ptr<PixelPart> pixel_fragments_part() { return std::make_unique<FragmentsPart>(); }

}  // namespace strata::ui
