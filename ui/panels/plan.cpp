// The plan of a frame: which step writes and reads what, what waits for what, who shares memory, what was left out and why.
#include <algorithm>
#include <array>

#include "passes/graph/describe.h"
#include "passes/stages.h"
#include "replay/plural.h"
#include "ui/panel.h"
#include "ui/plan/plan_chart.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

enum class PlanMode : std::size_t { steps, memory, left_out };

constexpr ImGuiTableFlags table_flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_NoPadOuterX | ImGuiTableFlags_SizingFixedFit |
                                        ImGuiTableFlags_Resizable | ImGuiTableFlags_BordersInnerV;

class PlanPanel final : public Panel {
public:
    void draw(Model& model, Services& services) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("Plan");
        take_picture(services);
        const bool is_of_label = !pictured_ || services.replayer.is_of(*pictured_, model.request());
        const auto updating = widgets.updating(updating_word(is_of_label, services.replayer, "plan"));
        draw_head(widgets);
        if (!picture_) return;
        if (mode_ == PlanMode::left_out) return draw_left_out(widgets);
        const float height = ImGui::GetContentRegionAvail().y;
        draw_chart(model, widgets, std::max(160.0f, height * .7f));
        ImGui::BeginChild("details");
        if (model.step && *model.step < picture_->steps.size()) draw_step(model, widgets, *model.step);
        else if (mode_ == PlanMode::memory) draw_stages(widgets);
        else widgets.text("hint", "click a step, or what it does to an image; the wheel zooms, dragging moves", &palette().dim);
        ImGui::EndChild();
    }

    bool is_busy() const override { return job_ && !job_->result(); }

private:
    /// The plan of what is shown: asked for when that changes.
    void take_picture(Services& services) {
        const auto replay = services.replayer.shown("A");
        if (replay && replay != planned_of_) {
            planned_of_ = replay;
            if (job_) job_->progress.cancel();
            const Request request = replay->request;
            job_ = services.replayer.start<PlanPicture>([request](Session& session, ui::Progress&) -> Result<PlanPicture> {
                return session.plan(request).and_then([&](auto& planned) { return picture_of(planned); });
            });
        }
        if (!job_ || !job_->result()) return;
        if (*job_->result()) {
            picture_ = **job_->result();
            pictured_ = planned_of_->made_of();
        } else {
            services.log.push_back({LogLine::Kind::failed, services.seconds, job_->result()->error().sentence});
        }
        job_.reset();
    }

    void draw_head(Widgets& widgets) {
        constexpr std::array<std::string_view, 3> modes = {"Steps and images", "Memory", "Left out"};
        ImGui::SetNextItemWidth(150);
        if (const auto chosen = widgets.combo("show", modes, static_cast<std::size_t>(mode_))) {
            mode_ = static_cast<PlanMode>(*chosen);
            view_ = {};
        }
        if (mode_ == PlanMode::steps) {
            ImGui::SameLine();
            if (const auto set = widgets.checkbox("buffers", with_buffers_)) with_buffers_ = *set;
            widgets.help("buffers of the plan beside its images");
            ImGui::SameLine();
            if (const auto set = widgets.checkbox("imported", with_imported_)) with_imported_ = *set;
            widgets.help("what comes from outside of the plan: the scene, what was kept of earlier replays");
        }
        if (mode_ != PlanMode::left_out) {
            ImGui::SameLine();
            if (widgets.button("all", "Fit")) view_ = {};
            widgets.help("all columns; so does a double click");
        }
        if (!picture_) {
            widgets.text("state", "nothing planned yet", &palette().dim);
            return;
        }
        ImGui::SameLine(0, 14);
        widgets.text("counts",
                     fmt::format("{}, {}, {} left out", plural(picture_->steps.size(), "step"),
                                 plural(picture_->barriers(), "barrier"), picture_->skipped.size() + picture_->culled.size()),
                     &palette().dim);
        const std::uint64_t saved = picture_->unshared_bytes - std::min(picture_->unshared_bytes, picture_->image_bytes);
        ImGui::PushTextWrapPos(0);
        widgets.text("bytes",
                     fmt::format("images {} ({} saved by sharing), buffers {}; {} alive at most, at {}",
                                 size_text(picture_->image_bytes), size_text(saved), size_text(picture_->buffer_bytes),
                                 size_text(picture_->over_time.peak), picture_->over_time.fullest_step),
                     &palette().dim);
        ImGui::PopTextWrapPos();
    }

    /// The resources that have a row.
    std::vector<std::size_t> rows() const {
        std::vector<std::size_t> shown;
        for (std::size_t i = 0; i < picture_->resources.size(); ++i) {
            const PlanResource& resource = picture_->resources[i];
            if ((resource.is_image || with_buffers_) && (!resource.is_imported || with_imported_)) shown.push_back(i);
        }
        return shown;
    }

    void draw_chart(Model& model, Widgets& widgets, float height) {
        const bool is_memory = mode_ == PlanMode::memory;
        const std::vector<std::size_t> resources = rows();
        const ImVec2 size(std::max(240.0f, ImGui::GetContentRegionAvail().x), height);
        widgets.canvas("chart", size, fmt::format("{} rows", is_memory ? picture_->memory.size() : resources.size()));
        const ImVec2 from = ImGui::GetItemRectMin();
        const ChartSize cells{picture_->steps.size(), is_memory ? picture_->memory.size() : resources.size(),
                              names_height(picture_->steps), is_memory ? alive_height : 0};
        PlanChart chart = place(view_, from, size, cells);
        if (model.step != step_seen_ && model.step) view_ = shown(view_, chart, *model.step);
        step_seen_ = model.step;
        take_mouse(chart);
        chart = place(view_, from, size, cells);

        const bool clicked = was_clicked();
        PlanMarks marks;
        if (model.step && *model.step < picture_->steps.size()) marks.step = model.step;
        if (ImGui::IsItemHovered()) {
            marks.step_under = chart.step_at(ImGui::GetIO().MousePos);
            marks.row_under = chart.row_at(ImGui::GetIO().MousePos);
        }
        if (!is_memory) marks.row = row_of_image(model, resources);
        ImGui::GetWindowDrawList()->AddRectFilled(from, chart.to, packed({0, 0, 0, .18f}), 3);
        if (is_memory) draw_memory(chart, *picture_, marks);
        else draw_resources(chart, *picture_, resources, marks);
        draw_steps(chart, *picture_, marks);
        const auto under = is_memory ? resource_in_memory(marks) : resource_of(marks, resources);
        widgets.help(help_of(marks, under));
        if (clicked) select(model, marks.step_under, under);
    }

    void take_mouse(const PlanChart& chart) {
        const ImGuiIO& io = ImGui::GetIO();
        ChartMouse mouse{.at = io.MousePos};
        if (ImGui::IsItemHovered()) mouse.wheel = io.MouseWheel;
        if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) mouse.pulled = io.MouseDelta;
        if (mouse.wheel != 0 || mouse.pulled.x != 0 || mouse.pulled.y != 0) view_ = moved(view_, chart, mouse);
        if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) view_ = {};
    }

    static bool was_clicked() {
        return ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
               ImGui::GetIO().MouseDragMaxDistanceSqr[0] < 9;
    }

    std::optional<std::size_t> row_of_image(const Model& model, const std::vector<std::size_t>& resources) const {
        for (std::size_t i = 0; i < resources.size(); ++i) {
            const PlanResource& resource = picture_->resources[resources[i]];
            if (model.image.step && resource.is_image && resource.name == model.image.name) return i;
        }
        return {};
    }

    static std::optional<std::size_t> resource_of(const PlanMarks& marks, const std::vector<std::size_t>& resources) {
        return marks.row_under ? std::optional(resources[*marks.row_under]) : std::nullopt;
    }

    /// Whose the memory under the pointer is at that step.
    std::optional<std::size_t> resource_in_memory(const PlanMarks& marks) const {
        if (!marks.row_under || !marks.step_under) return {};
        for (const std::size_t owner : picture_->memory[*marks.row_under].resources) {
            const PlanResource& resource = picture_->resources[owner];
            if (resource.first() <= *marks.step_under && *marks.step_under <= resource.last) return owner;
        }
        return {};
    }

    std::string help_of(const PlanMarks& marks, std::optional<std::size_t> under) const {
        std::string help;
        if (marks.step_under) {
            const PlanStep& step = picture_->steps[*marks.step_under];
            help = fmt::format("{} {}\n{}\n{}, {} before it", *marks.step_under, step.name, text_of(step.scope), step.work,
                               plural(step.barriers.size(), "barrier"));
        }
        if (!under) return help;
        const PlanResource& resource = picture_->resources[*under];
        help += fmt::format("{}{}{}", help.empty() ? "" : "\n\n", resource.name,
                            resource.is_image ? fmt::format("\n{}", resource.shape) : "");
        help += fmt::format("\n{}{}", size_text(resource.bytes), resource.is_imported ? ", from outside of the plan" : "");
        help += life_text(resource);
        if (const PlanTouch* touch = marks.step_under ? resource.touch(*marks.step_under) : nullptr)
            help += fmt::format("\n{} by this step", touch->access);
        return help;
    }

    std::string life_text(const PlanResource& resource) const {
        std::string text = fmt::format("\nfrom step {} to {}", resource.first(),
                                       resource.is_kept ? "the end, where it is read back" : fmt::format("{}", resource.last));
        if (!resource.memory) return text;
        for (const std::size_t other : picture_->memory[*resource.memory].resources)
            if (&picture_->resources[other] != &resource)
                text += fmt::format("\nshares its memory with {}", picture_->resources[other].name);
        return text;
    }

    /// A step shows what it writes; an image in a step is shown as it is after that step.
    void select(Model& model, std::optional<std::size_t> step, std::optional<std::size_t> under) const {
        const PlanResource* resource = under ? &picture_->resources[*under] : nullptr;
        if (!step && resource) step = resource->writer(picture_->steps.size());  // a name: as the last writer left it
        if (!step) {
            model.step.reset();
            return;
        }
        model.step = step;
        const bool is_alive = resource && resource->is_image && resource->first() <= *step && *step <= resource->last;
        if (is_alive) {
            model.image = {.name = resource->name, .step = resource->writer(*step).value_or(*step)};
            return;
        }
        for (const PlanResource& each : picture_->resources) {
            const PlanTouch* touch = each.touch(*step);
            if (!touch || !touch->writes || !each.is_image) continue;
            model.image = {.name = each.name, .step = step};
            return;
        }
    }

    void draw_step(Model& model, Widgets& widgets, std::size_t index) {
        const PlanStep& step = picture_->steps[index];
        const auto scope = widgets.in("step");
        const ImVec4 color = color_of_stage(static_cast<std::size_t>(step.scope.stage));
        widgets.text("name", fmt::format("{} {}", index, step.name), &color);
        widgets.help(text_of(step.scope));
        ImGui::SameLine(0, 12);
        widgets.text("work", step.work, &palette().dim);
        draw_touched(model, widgets, index);
        ImGui::Dummy({0, 3});
        widgets.text("barriers", fmt::format("{} before it", plural(step.barriers.size(), "barrier")), &palette().dim);
        widgets.help("stages and accesses to wait for, and the change of image layout");
        for (std::size_t i = 0; i < step.barriers.size(); ++i) {
            ImGui::Indent(10);
            widgets.text(fmt::format("barrier {}", i), step.barriers[i]);
            ImGui::Unindent(10);
        }
    }

    /// What a step writes and reads, and for how long that lives.
    void draw_touched(Model& model, Widgets& widgets, std::size_t index) {
        if (!ImGui::BeginTable("touched", 4, table_flags)) return;
        for (const char* name : {"image or buffer", "access", "is", "bytes"}) ImGui::TableSetupColumn(name);
        ImGui::TableHeadersRow();
        for (std::size_t i = 0; i < picture_->resources.size(); ++i) {
            const PlanResource& resource = picture_->resources[i];
            const PlanTouch* touch = resource.touch(index);
            if (!touch || (resource.is_imported && !resource.is_image)) continue;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            const std::string label = fmt::format("{} {}", i, resource.name);
            const bool is_shown = model.image.step && model.image.name == resource.name;
            if (widgets.selectable(label, is_shown, resource.name)) select(model, index, i);
            widgets.help(life_text(resource).substr(1));
            const auto scope = widgets.in(label);
            ImGui::TableNextColumn();
            widgets.text("access", touch->access, touch->writes ? &palette().warning : &palette().dim);
            ImGui::TableNextColumn();
            widgets.text("shape", resource.is_image ? resource.shape : "buffer", &palette().dim);
            ImGui::TableNextColumn();
            widgets.text("bytes", size_text(resource.bytes), &palette().dim);
        }
        ImGui::EndTable();
    }

    void draw_stages(Widgets& widgets) const {
        if (!ImGui::BeginTable("stages", 3, table_flags)) return;
        for (const char* name : {"stage", "uses first", "alive at most"}) ImGui::TableSetupColumn(name);
        ImGui::TableHeadersRow();
        for (const StageInfo& stage : stages()) {
            const auto memory = picture_->over_time.stages.find(std::string(stage.name));
            if (memory == picture_->over_time.stages.end()) continue;
            const auto scope = widgets.in(stage.name);
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            const ImVec4 color = color_of_stage(static_cast<std::size_t>(stage.stage));
            widgets.text("stage", stage.name, &color);
            ImGui::TableNextColumn();
            widgets.text("allocated", size_text(memory->second.allocated));
            widgets.help("images and buffers that the steps of this stage are the first to use");
            ImGui::TableNextColumn();
            widgets.text("peak", size_text(memory->second.peak));
            widgets.help("the most that is alive at one of its steps, whatever stage made it");
        }
        ImGui::EndTable();
    }

    void draw_left_out(Widgets& widgets) const {
        const auto scope = widgets.in("left out");
        ImGui::BeginChild("left out");
        if (picture_->skipped.empty() && picture_->culled.empty()) widgets.text("none", "nothing was left out", &palette().dim);
        if (ImGui::BeginTable("reasons", 2, table_flags)) {
            ImGui::TableSetupColumn("stage or step");
            ImGui::TableSetupColumn("why", ImGuiTableColumnFlags_WidthStretch);
            ImGui::TableHeadersRow();
            for (const SkippedStage& skipped : picture_->skipped)
                draw_reason(widgets, name(skipped.stage), fmt::format("stage {}", name(skipped.stage)), skipped.reason);
            for (std::size_t i = 0; i < picture_->culled.size(); ++i) {
                const CulledStep& culled = picture_->culled[i];
                draw_reason(widgets, fmt::format("{} {}", i, culled.name), culled.name, culled.reason);
            }
            ImGui::EndTable();
        }
        ImGui::EndChild();
    }

    static void draw_reason(Widgets& widgets, std::string_view label, const std::string& what, std::string_view why) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(what.c_str());
        ImGui::TableNextColumn();
        ImGui::PushTextWrapPos(0);
        widgets.text(label, why, &palette().dim);
        ImGui::PopTextWrapPos();
    }

    std::shared_ptr<const Replay> planned_of_;
    JobOf<PlanPicture> job_;
    std::optional<PlanPicture> picture_;
    std::optional<MadeOf> pictured_;
    PlanMode mode_ = PlanMode::steps;
    bool with_buffers_ = false, with_imported_ = false;
    ChartView view_;
    std::optional<std::size_t> step_seen_;  ///< the selection that was scrolled to
};

}  // namespace

std::unique_ptr<Panel> plan_panel() { return std::make_unique<PlanPanel>(); }

}  // namespace strata::ui
