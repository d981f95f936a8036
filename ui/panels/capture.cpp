// What the frame is made of, as tables. A draw or an emitter that is selected is outlined in the picture.
#include <algorithm>

#include "capture_format/frame/frame.h"
#include "replay/plural.h"
#include "ui/frame/capture_tables.h"
#include "ui/frame/counter_rows.h"
#include "ui/panel.h"
#include "ui/picture/outline.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

class CapturePanel final : public Panel {
public:
    void draw(Model& model, Services& services) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("Capture");
        const auto replay = services.replayer.shown("A");
        if (replay) take_tables(model, services, replay->request.variant.frame);
        if (tables_.empty()) {
            widgets.text("state", "the frame is being read", &palette().dim);
            return;
        }
        if (replay) take_outline(model, services, *replay);
        const bool is_of_label = tables_of_ == model.edits().variant.frame;
        const auto updating = widgets.updating(updating_word(is_of_label, services.replayer, "tables"));
        draw_head(model, widgets);
        draw_table(model, widgets, tables_[table_]);
    }

    bool is_busy() const override { return (reading_ && !reading_->result()) || (outlining_ && !outlining_->result()); }

private:
    using Tables = std::vector<CaptureTable>;

    /// The tables of a frame: read once, on the session's thread, because textures and meshes are large.
    void take_tables(Model& model, Services& services, std::size_t frame) {
        if (frame_ != frame) {
            if (frame_) model.draw.reset();  // another frame's draws have other numbers
            frame_ = frame;
            if (reading_) reading_->progress.cancel();
            reading_ = services.replayer.start<Tables>([frame](Session& session, ui::Progress&) -> Result<Tables> {
                return session.frame(frame).and_then([&](auto& read) { return capture_tables(read); });
            });
        }
        if (!reading_ || !reading_->result()) return;
        if (*reading_->result()) {
            tables_ = **reading_->result();
            tables_of_ = frame;
        } else {
            services.log.push_back({LogLine::Kind::failed, services.seconds, reading_->result()->error().sentence});
        }
        reading_.reset();
        table_ = std::min(table_, tables_.size() - 1);
        order_is_known_ = false;
    }

    /// The pixels of the selected draw, asked for when the draw changes, or what the picture is made with.
    void take_outline(Model& model, Services& services, const Replay& replay) {
        Request request = replay.request;
        request.outputs.clear();
        if (!model.draw) {
            model.outline.reset();
            outlined_.reset();
        } else if (outlined_ != std::pair(request, *model.draw)) {
            outlined_ = {request, *model.draw};
            if (outlining_) outlining_->progress.cancel();
            const std::uint32_t draw = *model.draw;
            const std::uint32_t width = replay.run.width;
            outlining_ = services.replayer.start<Outline>([=](Session& session, ui::Progress&) -> Result<Outline> {
                const auto cover = session.draw_cover(request, draw);
                if (!cover) return cover.error();
                Outline outline = outline_of(*cover, width);
                outline.draw = draw;
                outline.request = request;
                return outline;
            });
        }
        if (!outlining_ || !outlining_->result()) return;
        const Result<Outline>& result = *outlining_->result();
        if (result && outlined_ && model.draw == result->draw) model.outline = std::make_shared<Outline>(*result);
        if (!result) {
            model.outline.reset();
            services.log.push_back({LogLine::Kind::failed, services.seconds, result.error().sentence});
        }
        outlining_.reset();
    }

    void draw_head(Model& model, Widgets& widgets) {
        std::vector<std::string_view> names;
        for (const CaptureTable& table : tables_) names.push_back(table.name);
        ImGui::SetNextItemWidth(150);
        if (const auto chosen = widgets.combo("table", names, table_)) {
            table_ = *chosen;
            selected_.reset();
            order_is_known_ = false;
        }
        widgets.help(tables_[table_].help);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(150);
        if (auto text = widgets.input("find", find_, "find in all columns")) {
            find_ = *std::move(text);
            order_is_known_ = false;
        }
        ImGui::SameLine();
        if (!order_is_known_) order_ = rows_with(tables_[table_], find_);
        const std::size_t all = tables_[table_].rows.size();
        widgets.text("rows", order_.size() == all ? plural(all, "row") : fmt::format("{} of {}", order_.size(), all),
                     &palette().dim);
        if (model.draw) draw_cover_line(model, widgets);
    }

    /// What is known of the selected draw's pixels.
    void draw_cover_line(Model& model, Widgets& widgets) const {
        const bool is_of_label =
            model.outline && model.outline->draw == model.draw && model.outline->request == without_outputs(model.request());
        const Outline* outline = is_of_label ? model.outline.get() : nullptr;
        if (!outline) return widgets.text("cover", "looking for its pixels\xe2\x80\xa6", &palette().dim);
        if (outline->shown + outline->hidden == 0) return widgets.text("cover", "not in the picture", &palette().warning);
        const std::string hidden =
            outline->hidden > 0 ? fmt::format(", {} hidden behind opaque surfaces", grouped(outline->hidden)) : "";
        widgets.text("cover", fmt::format("shown in {} pixels{}", grouped(outline->shown), hidden), &palette().warning);
        ImGui::SameLine();
        if (widgets.button("go there", "Go there")) go_to(model, *outline);
        widgets.help("brings its pixels to the middle of the picture");
        ImGui::SameLine();
        if (widgets.button("no outline", "\xc3\x97")) model.draw.reset();
        widgets.help("takes the outline away");
    }

    /// The pixels in the middle, about as high as half a picture's usual place in the window.
    static void go_to(Model& model, const Outline& outline) {
        const double high = std::max(1u, outline.to.y - outline.from.y), wide = std::max(1u, outline.to.x - outline.from.x);
        const ImVec2 window = ImGui::GetIO().DisplaySize;
        model.view.zoom = std::clamp(std::min(.25 * double{window.x} / wide, .3 * double{window.y} / high), .25, 32.0);
        model.view.center_x = (outline.from.x + outline.to.x) / 2.0;
        model.view.center_y = (outline.from.y + outline.to.y) / 2.0;
    }

    void draw_table(Model& model, Widgets& widgets, const CaptureTable& table) {
        if (table.rows.empty()) return widgets.text("none", fmt::format("this frame has no {}", table.name), &palette().dim);
        constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_NoPadOuterX | ImGuiTableFlags_ScrollX |
                                          ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_Resizable |
                                          ImGuiTableFlags_Sortable | ImGuiTableFlags_BordersInnerV;
        const auto scope = widgets.in(table.name);
        if (!ImGui::BeginTable("rows", static_cast<int>(table.columns.size()), flags)) return;
        for (const CaptureColumn& column : table.columns) ImGui::TableSetupColumn(std::string(column.name).c_str());
        ImGui::TableSetupScrollFreeze(1, 1);
        draw_titles(widgets, table);
        sort(table);
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(order_.size()));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
                draw_row(model, widgets, table, order_[static_cast<std::size_t>(i)]);
        ImGui::EndTable();
    }

    /// As TableHeadersRow() does, with help on each.
    static void draw_titles(Widgets& widgets, const CaptureTable& table) {
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        for (const CaptureColumn& column : table.columns) {
            ImGui::TableNextColumn();
            ImGui::TableHeader(std::string(column.name).c_str());
            widgets.help(column.help);
        }
    }

    void sort(const CaptureTable& table) {
        ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
        const bool is_sorted = specs && specs->SpecsCount > 0;
        if (!order_is_known_ || (specs && specs->SpecsDirty)) {
            order_ = rows_with(table, find_);
            const bool is_down = is_sorted && specs->Specs->SortDirection == ImGuiSortDirection_Descending;
            const auto column = is_sorted ? static_cast<std::size_t>(specs->Specs->ColumnIndex) : 0;
            sort_rows(table, column, is_down ? SortDirection::down : SortDirection::up, order_);
        }
        order_is_known_ = true;
        if (specs) specs->SpecsDirty = false;
    }

    void draw_row(Model& model, Widgets& widgets, const CaptureTable& table, std::size_t index) {
        const std::vector<CaptureCell>& cells = table.rows[index];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::optional<std::uint32_t> draw =
            table.first_draw ? std::optional(*table.first_draw + static_cast<std::uint32_t>(index)) : std::nullopt;
        const bool is_selected = draw ? model.draw == draw : selected_ == index;
        if (widgets.selectable(cells.front().text, is_selected)) {
            if (draw) model.draw = is_selected ? std::nullopt : draw;
            else selected_ = is_selected ? std::nullopt : std::optional(index);
        }
        if (draw) widgets.help("a click outlines it in the picture");
        const auto scope = widgets.in(cells.front().text);
        for (std::size_t i = 1; i < cells.size(); ++i) {
            ImGui::TableNextColumn();
            const bool is_zero = cells[i].number == 0;
            widgets.text(table.columns[i].name, cells[i].text, is_zero ? &palette().dim : nullptr);
        }
    }

    std::optional<std::size_t> frame_, selected_;  ///< selected: a row of what is not seen in the picture
    JobOf<Tables> reading_;
    Tables tables_;
    std::optional<std::size_t> tables_of_;  ///< frame
    std::size_t table_ = 0;
    std::string find_;
    std::vector<std::size_t> order_;
    bool order_is_known_ = false;
    std::optional<std::pair<Request, std::uint32_t>> outlined_;  ///< the latest that was asked for
    JobOf<Outline> outlining_;
};

}  // namespace

std::unique_ptr<Panel> capture_panel() { return std::make_unique<CapturePanel>(); }

}  // namespace strata::ui
