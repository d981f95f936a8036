// T(z) of any set of techniques over the exact steps of the pinned pixel.
#include <algorithm>
#include <array>
#include <set>

#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/plural.h"
#include "replay/probe/order.h"
#include "replay/probe/probe_columns.h"
#include "ui/pixel/pixel_part.h"
#include "ui/pixel/probe_series.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

// Of the list of techniques six rows are seen at a time: at 800 pixels plot and figures fit below it.
constexpr float list_height = 156, least_plot = 190, most_plot = 420;

std::string help_of(const ProbeCurve& curve) {
    std::string text = curve.variant;
    if (!curve.slices.empty()) {
        const auto [thinnest, thickest] =
            std::ranges::minmax(curve.slices, {}, [](const DepthSpan& slice) { return slice.to - slice.from; });
        text += fmt::format("\n{} of depth, {:.3g} to {:.3g} m thick", plural(curve.slices.size(), "slice"),
                            thinnest.to - thinnest.from, thickest.to - thickest.from);
    }
    for (const std::string& note : curve.notes) text += fmt::format("\n{}", note);
    return text;
}

class ProbePart final : public PixelPart {
public:
    void draw(Model& model, Services& services, const Replay& replay) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("probe");
        draw_options(model, widgets, replay);
        const ProbeQuestion question = question_of(model, replay);
        if (question.variants.empty()) {
            widgets.text("state", "no technique is chosen", &palette().dim);
            return;
        }
        ask(services, question);
        draw_state_of(widgets, asked_);
        const Probe* probe = asked_.answer();
        if (!probe) return;
        const auto updating = widgets.updating(updating_word(asked_, question, model, services));
        if (probe->undecided) widgets.text("undecided", "rounding decides which fragments exist here", &palette().warning);
        draw_curves(widgets, *probe);
        draw_metrics(widgets, *probe);
    }
    void withdraw() override { asked_.withdraw(); }
    bool is_busy() const override { return asked_.progress() != nullptr; }

private:
    ProbeQuestion question_of(const Model& model, const Replay& replay) const {
        ProbeQuestion question{with_display_alone(replay.request), glm::uvec2(*model.pin)};
        question.sample = std::min(sample_, replay.run.samples - 1);
        question.axis = logarithmic_ ? DepthAxis::logarithmic : DepthAxis::linear;
        const std::string now = variant_of(model.choices().at(Stage::transparency));
        if (as_chosen_) question.variants.push_back(now);
        for (const std::string& variant : variants_)
            if (!as_chosen_ || variant != now) question.variants.push_back(variant);
        return question;
    }

    /// Curves of the same fragments are kept, so that one technique more costs one technique.
    void ask(Services& services, const ProbeQuestion& question) {
        std::optional<Probe> known;
        if (const ProbeQuestion* before = asked_.answered(); before && asked_.has_shaders_of(services.replayer)) {
            ProbeQuestion same = *before;
            same.variants = question.variants;
            if (same == question && before->variants != question.variants) known = *asked_.answer();
        }
        asked_.ask(services.replayer, question,
                   [known = std::move(known)](Session& session, Progress& progress, const ProbeQuestion& asked) {
                       return probe_each(session, progress, asked, known);
                   });
    }

    void draw_options(const Model& model, Widgets& widgets, const Replay& replay) {
        constexpr std::array<std::string_view, 2> axes = {"log z", "linear z"}, quantities = {"T(z)", "T(z) less exact"};
        constexpr std::array<std::string_view, 4> channels = {"mean", "red", "green", "blue"};
        ImGui::SetNextItemWidth(84);
        if (const auto axis = widgets.combo("axis", axes, logarithmic_ ? 0 : 1)) {
            logarithmic_ = *axis == 0;
            view_ = {.hidden = view_.hidden};
        }
        ImGui::SameLine();
        ImGui::SetNextItemWidth(118);
        if (const auto quantity = widgets.combo("quantity", quantities, static_cast<std::size_t>(quantity_))) {
            quantity_ = static_cast<ProbeQuantity>(*quantity);
            view_ = {.hidden = view_.hidden};
        }
        ImGui::SameLine();
        ImGui::SetNextItemWidth(72);
        if (const auto channel = widgets.combo("channel", channels, static_cast<std::size_t>(channel_)))
            channel_ = static_cast<ProbeChannel>(*channel);
        widgets.help("of the light that is let through: colored glass lets channels through differently");
        if (replay.run.samples > 1) {
            ImGui::SetNextItemWidth(-60);
            const auto sample = widgets.slider("sample", std::min(sample_, replay.run.samples - 1),
                                               {.high = replay.run.samples - 1.0, .whole = true});
            if (sample) sample_ = static_cast<std::uint32_t>(*sample);
            ImGui::SameLine();
            ImGui::TextDisabled("sample");
        }
        draw_variants(model, widgets);
    }

    void draw_variants(const Model& model, Widgets& widgets) {
        if (!widgets.tree("techniques", false).open) return;
        const std::string now = short_variant(variant_of(model.choices().at(Stage::transparency)));
        if (const auto set = widgets.checkbox("as chosen", as_chosen_)) as_chosen_ = *set;
        widgets.help(now);
        ImGui::SameLine();
        const std::vector<const Technique*> known = techniques_of(Stage::transparency);
        if (widgets.button("all"))
            for (const Technique* technique : known) variants_.emplace(technique->name);
        widgets.help("every technique of the stage as it is by default");
        ImGui::SameLine();
        if (widgets.button("none")) variants_.clear();
        ImGui::BeginChild("list", {0, list_height}, true);
        for (const Technique* technique : known) draw_variant(widgets, std::string(technique->name), technique->summary);
        if (widgets.tree("other settings", false).open) {
            for (const Technique* technique : known)
                for (const std::string_view point : technique->variants)
                    draw_variant(widgets, fmt::format("{} {}", technique->name, point), technique->summary);
            widgets.tree_end();
        }
        ImGui::EndChild();
        widgets.tree_end();
    }

    void draw_variant(Widgets& widgets, const std::string& variant, std::string_view help) {
        const auto set = widgets.checkbox(short_variant(variant), variants_.contains(variant));
        widgets.help(help);
        if (!set) return;
        if (*set) variants_.insert(variant);
        else variants_.erase(variant);
    }

    void draw_curves(Widgets& widgets, const Probe& probe) {
        const Look look{asked_.version(), quantity_, channel_};
        if (look != drawn_) {
            series_ = series_of(probe, quantity_, channel_);
            drawn_ = look;
        }
        const bool is_error = quantity_ == ProbeQuantity::error;
        // Half of what is left: the figures stand below.
        const float height = std::clamp(ImGui::GetContentRegionAvail().y * .5f, least_plot, most_plot);
        const AxisScale scale = probe.axis == DepthAxis::logarithmic ? AxisScale::logarithmic : AxisScale::linear;
        const PlotAxis depth{"m of view depth", scale}, transmittance{is_error ? "T less exact T" : "T"};
        draw_plot(widgets, {"plot", depth, transmittance, {ImGui::GetContentRegionAvail().x, height}}, series_, view_);
    }

    static void draw_metrics(Widgets& widgets, const Probe& probe) {
        const auto scope = widgets.in("metrics");
        constexpr ImGuiTableFlags flags =
            ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollX | ImGuiTableFlags_NoPadOuterX;
        // A table that scrolls sideways needs its height said: a row each and the head.
        const float rows = static_cast<float>(probe.curves.size() + 2);
        if (!ImGui::BeginTable("errors", 7, flags, {0, rows * ImGui::GetTextLineHeightWithSpacing() + 14})) return;
        const std::vector<const ProbeCurve*> curves = best_first(probe);
        const Sheet sheet = variants_of(curves);
        ImGui::TableSetupColumn("variant");
        for (const Described& is : sheet.columns)
            if ((is.shown & in_window) != 0) ImGui::TableSetupColumn(window_title(is).c_str());
        ImGui::TableHeadersRow();
        for (std::size_t i = 0; i < curves.size(); ++i) draw_row(widgets, probe, *curves[i], {sheet, i});
        ImGui::EndTable();
        ImGui::PushTextWrapPos(0);
        widgets.text(
            "meaning",
            fmt::format("Best first. Display: the pixel of the frame, of white. Errors of T from {:.4g} to {:.4g} m. L1: mean "
                        "over the axis. Off steps: largest, "
                        "at least 1% of the axis away from every step. At fragments: mean over fragments, weighted by what "
                        "each hides. Behind: error of T behind all fragments.",
                        probe.from, probe.to),
            &palette().dim);
        ImGui::PopTextWrapPos();
    }

    /// The figures of a curve: a row of the probe's sheet.
    struct FigureRow {
        const Sheet& sheet;
        std::size_t place = 0;
    };

    static void draw_row(Widgets& widgets, const Probe& probe, const ProbeCurve& curve, const FigureRow& row) {
        const auto scope = widgets.in(short_variant(curve.variant));
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const ImVec4 color = color_of_variant(static_cast<std::size_t>(&curve - probe.curves.data()));
        widgets.text("variant", fmt::format("{} {}", row.place + 1, short_variant(curve.variant)), &color);
        widgets.help(help_of(curve));
        if (!curve.not_supported.empty()) {
            ImGui::TableNextColumn();
            widgets.text("not supported", "not supported", &palette().warning);
            widgets.help(curve.not_supported);
            return;
        }
        for (std::size_t i = 0; i < row.sheet.columns.size(); ++i) {
            const Described& is = row.sheet.columns[i];
            if ((is.shown & in_window) == 0) continue;
            ImGui::TableNextColumn();
            widgets.text(window_title(is), window_cell(is, row.sheet.rows[row.place].values[i]).text);
        }
    }

    /// What the series were made of.
    struct Look {
        std::size_t version = 0;
        ProbeQuantity quantity = ProbeQuantity::transmittance;
        ProbeChannel channel = ProbeChannel::mean;
        friend bool operator==(const Look&, const Look&) = default;
    };

    LiveQuery<ProbeQuestion, Probe> asked_;
    std::vector<PlotSeries> series_;
    Look drawn_;
    PlotView view_;
    std::set<std::string> variants_;
    bool as_chosen_ = true, logarithmic_ = true;
    std::uint32_t sample_ = 0;
    ProbeQuantity quantity_ = ProbeQuantity::transmittance;
    ProbeChannel channel_ = ProbeChannel::mean;
};

}  // namespace

std::unique_ptr<PixelPart> pixel_probe_part() { return std::make_unique<ProbePart>(); }

}  // namespace strata::ui
