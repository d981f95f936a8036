// Accuracy and cost: every technique of a stage at its settings against the truth, as `strata report` measures them; any error
// over any cost, and a click that applies a setting.
#include <algorithm>
#include <array>

#include "capture_format/reader.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "replay/plural.h"
#include "replay/report/variants.h"
#include "ui/panel.h"
#include "ui/report/report_job.h"
#include "ui/report/report_table.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr std::array<std::size_t, 5> turns = {1, 3, 7, 15, 31};
// Side by side needs room for a plot and a table of six columns.
constexpr float side_by_side = 900;

using Kind = ReportColumn::Kind;

/// What an axis shows.
struct AxisChoice {
    std::string label;               ///< of the column; empty: the first
    std::optional<AxisScale> scale;  ///< none: as the numbers need
};

class CostPanel final : public Panel {
public:
    void draw(Model& model, Services& services) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("Accuracy and cost");
        if (!model.is_known()) {
            widgets.text("state", "the capture is being opened", &palette().dim);
            return;
        }
        forget_other_frames(model);
        take_study(services);
        draw_head(model, services);
        const auto study = studies_.find(stage_);
        draw_state(model, services, study == studies_.end() ? nullptr : &study->second);
        if (study == studies_.end() || study->second.columns.empty()) return;
        draw_axes(widgets, study->second);
        draw_study(model, widgets, study->second);
    }

    bool is_busy() const override { return job_ && !job_->result(); }

private:
    // What runs.

    void start(JobOf<Study> job, const Services& services) {
        job_ = std::move(job);
        began_ = services.seconds;
        running_ = stage_;
        failure_.clear();
    }

    void measure(const Model& model, Services& services) {
        const ReportRequest wanted{.base = report_base(model.request(), stage_), .stage = stage_, .repeats = turns[turns_]};
        start(start_report(services.replayer, wanted, model.capture.filename().string()), services);
    }

    void model_on(const GpuModel& gpu, const Study& study, const Model& model, Services& services) {
        start(start_modeling(services.replayer, study, gpu, model.program), services);
    }

    /// At once for who looks; the thread ends what it is in.
    void stop() {
        if (job_) job_->progress.cancel();
        job_.reset();
    }

    void forget_other_frames(const Model& model) {
        if (model.capture == capture_ && model.edits().variant.frame == frame_) return;
        stop();
        studies_.clear();
        failure_.clear();
        capture_ = model.capture;
        frame_ = model.edits().variant.frame;
    }

    void take_study(Services& services) {
        if (!job_ || !job_->result()) return;
        const Result<Study>& result = *job_->result();
        if (result) {
            const Study& study = *result;
            studies_.insert_or_assign(running_, study);
            // What was modeled is what one wants to see.
            if (running_ == stage_ && !study.missing.empty()) cost_ = {study.columns.back().label, {}};
            forget_zoom();
            services.log.push_back(
                {LogLine::Kind::said, services.seconds,
                 fmt::format("measured {} of {}", plural(study.report.rows.size(), "setting"), name(running_))});
        } else {
            failure_ = result.error().sentence;
            services.log.push_back({LogLine::Kind::failed, services.seconds, failure_});
        }
        job_.reset();
    }

    void forget_zoom() {
        view_.x.reset();
        view_.y.reset();
    }

    // The line above.

    void draw_head(Model& model, Services& services) {
        Widgets& widgets = services.widgets;
        draw_stage_choice(widgets);
        ImGui::SameLine();
        std::array<std::string, turns.size()> texts;
        std::array<std::string_view, turns.size()> items;
        for (std::size_t i = 0; i < turns.size(); ++i) items[i] = texts[i] = plural(turns[i], "repeat");
        ImGui::SetNextItemWidth(96);
        if (const auto chosen = widgets.combo("repeats", items, turns_)) turns_ = *chosen;
        widgets.help("how often each setting is timed, interleaved with all others; the median and its deviation are shown");
        ImGui::SameLine();
        if (job_) draw_progress(widgets);
        else draw_buttons(model, services);
    }

    void draw_stage_choice(Widgets& widgets) {
        std::vector<std::string_view> names;
        std::vector<Stage> known;
        for (const StageInfo& stage : stages()) {
            if (!stage.truth || techniques_of(stage.stage).empty()) continue;
            names.push_back(stage.name);
            known.push_back(stage.stage);
        }
        const auto current = static_cast<std::size_t>(std::ranges::find(known, stage_) - known.begin());
        ImGui::SetNextItemWidth(130);
        const auto chosen = widgets.combo("stage", names, current);
        widgets.help(info(stage_).purpose);
        if (!chosen) return;
        stage_ = known[*chosen];
        failure_.clear();
        error_ = cost_ = {};
        table_ = {};
        view_ = {};
    }

    void draw_progress(Widgets& widgets) {
        const bool pressed = widgets.button("cancel", "Cancel");
        ImGui::SameLine();
        ImGui::ProgressBar(static_cast<float>(job_->progress.fraction()), {-1, 0}, "");
        if (pressed) stop();
    }

    void draw_buttons(const Model& model, Services& services) {
        Widgets& widgets = services.widgets;
        const auto study = studies_.find(stage_);
        const bool is_known = study != studies_.end();
        ImGui::BeginDisabled(!reason_left_out(services).empty());
        if (widgets.button("measure", is_known ? "Measure again" : "Measure")) measure(model, services);
        ImGui::EndDisabled();
        widgets.help(
            "every technique of the stage at its settings: its error against the truth, its time and its memory; what strata "
            "report "
            "measures");
        if (!is_known) return;
        ImGui::SameLine();
        std::vector<std::string_view> gpus = modeled_gpus();
        gpus.insert(gpus.begin(), "model a GPU");
        ImGui::SetNextItemWidth(116);
        const auto chosen = widgets.combo("model", gpus, 0);
        widgets.help(
            "adds cycles modeled for a GPU that this machine need not have: shader invocations times the throughput that Mesa's "
            "compiler states");
        ImGui::SameLine();
        if (widgets.button("copy", "Copy CSV")) ImGui::SetClipboardText(as_csv(study->second.report).c_str());
        widgets.help("the whole report as comma-separated values");
        if (!chosen || *chosen == 0) return;
        if (const auto gpu = find_gpu_model(gpus[*chosen])) model_on(**gpu, study->second, model, services);
    }

    std::string reason_left_out(const Services& services) const {
        const auto replay = services.replayer.shown("A");
        if (!replay || replay->request.variant.frame != frame_) return {};
        const auto skipped = std::ranges::find(replay->skipped, stage_, &SkippedStage::stage);
        return skipped == replay->skipped.end() ? "" : skipped->reason;
    }

    // What must be known before the numbers are believed.

    void draw_state(const Model& model, const Services& services, const Study* study) {
        Widgets& widgets = services.widgets;
        ImGui::PushTextWrapPos(0);
        if (job_) widgets.text("doing", doing(services), &palette().dim);
        if (!failure_.empty()) widgets.text("failure", failure_, &palette().bad);
        const std::string left_out = reason_left_out(services);
        if (!left_out.empty())
            widgets.text("left out", fmt::format("the frame does not need this stage: {}", left_out), &palette().dim);
        if (!study) {
            if (left_out.empty() && !job_)
                widgets.text("state", "nothing is measured yet: it takes seconds on a GPU, minutes on a CPU", &palette().dim);
        } else {
            draw_summary(model, widgets, *study);
        }
        ImGui::PopTextWrapPos();
    }

    std::string doing(const Services& services) const {
        const std::string step = job_->progress.doing();
        return fmt::format("{}: {}, for {:.0f} s", name(running_), step.empty() ? "waiting for its turn" : step,
                           services.seconds - began_);
    }

    void draw_summary(const Model& model, Widgets& widgets, const Study& study) const {
        const Report& report = study.report;
        if (!report.skipped.empty()) {
            widgets.text("skipped", fmt::format("the frame did not need this stage: {}", report.skipped), &palette().dim);
            return;
        }
        widgets.text("summary",
                     fmt::format("{} of {}, {} each; truth: {}", plural(report.rows.size(), "setting"), name(report.stage),
                                 plural(report.repeats, "repeat"), report.truths.front().is),
                     &palette().dim);
        widgets.help(fmt::format(
            "measured on {}{}", report.device.name,
            report.device.software ? "\na CPU renders here: times rank techniques on this driver only, they model no GPU" : ""));
        if (report_base(model.request(), report.stage) != study.base)
            widgets.text("stale", "measured before other stages were changed: measure again", &palette().warning);
    }

    // Axes, plot, table.

    void draw_axes(Widgets& widgets, const Study& study) {
        ImGui::AlignTextToFramePadding();
        draw_axis(widgets, study, Kind::error, error_);
        ImGui::SameLine(0, 14);
        ImGui::TextDisabled("over");
        ImGui::SameLine();
        draw_axis(widgets, study, Kind::cost, cost_);
    }

    void draw_axis(Widgets& widgets, const Study& study, Kind kind, AxisChoice& axis) {
        const auto scope = widgets.in(kind == Kind::error ? "error" : "cost");
        std::vector<std::string_view> labels;
        for (const ReportColumn& column : study.columns)
            if (column.kind == kind) labels.push_back(column.label);
        const ReportColumn& shown = column_of(study.columns, kind, axis.label);
        ImGui::SetNextItemWidth(180);
        const auto current = static_cast<std::size_t>(std::ranges::find(labels, shown.label) - labels.begin());
        const auto chosen = widgets.combo("shows", labels, current);
        ImGui::SameLine();
        const bool is_logarithmic = axis.scale.value_or(natural_scale(shown)) == AxisScale::logarithmic;
        const auto set = widgets.checkbox("log", is_logarithmic);
        if (set) axis.scale = *set ? AxisScale::logarithmic : AxisScale::linear;
        if (chosen) axis = {std::string(labels[*chosen]), {}};
        if (set || chosen) forget_zoom();
    }

    void draw_study(Model& model, Widgets& widgets, const Study& study) {
        const ReportColumn& error = column_of(study.columns, Kind::error, error_.label);
        const ReportColumn& cost = column_of(study.columns, Kind::cost, cost_.label);
        const ReportAxes axes{error, cost, error_.scale.value_or(natural_scale(error)),
                              cost_.scale.value_or(natural_scale(cost))};
        const auto now = row_of(study.report, model.choices().at(stage_));
        const ReportPlot plot = plot_of(study.report, axes, now);
        if (plot.without_place > 0)
            widgets.text("without place",
                         fmt::format("{} of 0 cannot be on a logarithmic axis", plural(plot.without_place, "setting")),
                         &palette().warning);
        const ImVec2 room = ImGui::GetContentRegionAvail();
        const bool beside = room.x >= side_by_side;
        const ImVec2 size(beside ? room.x * .55f : room.x, beside ? room.y : std::max(230.0f, room.y * .66f));
        // Without scrolling, so that the wheel is the plot's.
        ImGui::BeginChild("plot", size, false, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
        const auto chosen = draw_points(widgets, plot, axes);
        ImGui::EndChild();
        if (beside) ImGui::SameLine();
        ImGui::BeginChild("table", {0, std::max(ImGui::GetContentRegionAvail().y, 150.0f)});
        const auto picked = table_.draw(widgets, study, {axes, now, in_plot_});
        ImGui::EndChild();
        if (chosen || picked) apply(model, study.report.rows[chosen ? *chosen : *picked]);
    }

    static void apply(Model& model, const Measurement& row) { model.apply(request_of(row, {}).choices); }

    /// The row that was clicked.
    std::optional<std::size_t> draw_points(Widgets& widgets, const ReportPlot& plot, const ReportAxes& axes) {
        const Plot shown{.label = "plot",
                         .x = {axes.cost.axis_label(), axes.cost_scale},
                         .y = {axes.error.axis_label(), axes.error_scale},
                         .size = {-1, -1},
                         .marked = table_.under() ? plot.point_of(*table_.under()) : std::nullopt};
        const PlotEvent event = draw_plot(widgets, shown, plot.series, view_);
        const auto row_at = [&](const std::optional<PlotPoint>& point) {
            return point ? std::optional(plot.rows[point->series][point->point]) : std::nullopt;
        };
        in_plot_ = row_at(event.under);
        return row_at(event.clicked);
    }

    Stage stage_ = ReportRequest().stage;
    std::size_t turns_ = 2;  ///< in `turns`: as many as strata report takes
    AxisChoice error_, cost_;
    PlotView view_;
    ReportTable table_;
    std::optional<std::size_t> in_plot_;  ///< the row whose point is under the mouse

    std::map<Stage, Study> studies_;  ///< of this frame of this capture
    std::filesystem::path capture_;
    std::size_t frame_ = 0;

    JobOf<Study> job_;
    Stage running_ = Stage::transparency;
    double began_ = 0;
    std::string failure_;
};

}  // namespace

std::unique_ptr<Panel> cost_panel() { return std::make_unique<CostPanel>(); }

}  // namespace strata::ui
