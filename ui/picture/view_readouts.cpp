#include "ui/picture/view_readouts.h"

#include <algorithm>

#include "passes/technique.h"
#include "passes/view_params.h"
#include "replay/difference/compare_images.h"
#include "replay/plural.h"
#include "ui/picture/legend.h"
#include "ui/widgets/param_widget.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr std::size_t rows_at_first = 3, rows_at_most = 256;
constexpr float label_width = 116, curve_height = 160;

/// A bar of the colors, with its ends in the view's unit.
void draw_legend(const Model& model, Widgets& widgets, const DebugView& view) {
    const auto own = model.looks.find(model.image.name);
    const Look look = own == model.looks.end() ? look_of(view) : own->second;
    const LookEnds ends = ends_of(look, view.unit);
    const ImVec2 size(std::max(40.0f, ImGui::GetContentRegionAvail().x), 12);
    widgets.canvas("legend", size, legend_text(view));
    draw_ramp(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), look);
    widgets.text("black", ends.black, &palette().dim);
    ImGui::SameLine(std::max(60.0f, size.x - ImGui::CalcTextSize(ends.white.c_str()).x));
    widgets.text("white", ends.white, &palette().dim);
}

void draw_param(Model& model, Widgets& widgets, const Technique& technique, const Param& param) {
    const auto scope = widgets.in(param.name);
    const double value = model.choices().at(technique.stage).settings.get(param.name);
    ImGui::AlignTextToFramePadding();
    widgets.text("name", param.name);
    widgets.help(param.help);
    ImGui::SameLine(label_width);
    ImGui::SetNextItemWidth(-1);
    const auto set = draw_value(widgets, param, value);
    if (set) model.set(technique.stage, param.name, *set);
}

std::string row_text(const NumberTable& table, std::size_t row) {
    std::string text;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        text += fmt::format("{}{} {}", c ? ",  " : "", table.columns[c].name, cell_text(table.columns[c], table.rows[row][c]));
    return text;
}

/// Of the pixel under the pointer, or of the pinned one.
void draw_pixel(const Model& model, Widgets& widgets, const TechniqueViews& found) {
    if (found.numbers.empty()) return;
    const auto scope = widgets.in("pixel");
    const std::optional<glm::ivec2> pixel = model.under ? model.under : model.pin;
    if (!pixel) {
        widgets.text("where", "point at the picture for the rows of a pixel's tile", &palette().dim);
        return;
    }
    widgets.text("where", fmt::format("tile of pixel {} {}", pixel->x, pixel->y), &palette().accent);
    const std::vector<PixelRow> rows = rows_of_pixel(found, *pixel);
    ImGui::PushTextWrapPos(0);
    if (rows.empty()) widgets.text("none", "nothing is shaded there", &palette().dim);
    for (const PixelRow& row : rows) {
        const auto of = widgets.in(row.table);
        widgets.text(fmt::format("{}", row.row), fmt::format("{}: {}", row.table, row_text(*row.numbers, row.row)));
    }
    ImGui::PopTextWrapPos();
}

void draw_overflow(Widgets& widgets, const Replay& replay, const Technique& technique) {
    const auto scope = widgets.in("overflow");
    for (const Counter& counter : technique.counters) {
        if (!counts_overflow(counter)) continue;
        const auto found = std::ranges::find_if(replay.run.counters, [&](const CounterRecord& record) {
            return record.technique == technique.name && record.name == counter.name;
        });
        if (found == replay.run.counters.end()) continue;
        ImGui::TextDisabled("%s", std::string(counter.name).c_str());
        widgets.help(counter.help);
        ImGui::SameLine(label_width * 1.6f);
        widgets.text(counter.name, fmt::format("{}", found->value), found->value > 0 ? &palette().warning : &palette().good);
        widgets.help(counter.help);
    }
}

void draw_curves(Widgets& widgets, const NumberTable& table, PlotView& view) {
    const PlotAxis x{std::string(table.columns[0].name)}, y{std::string(table.columns.back().unit)};
    draw_plot(widgets, {"curves", x, y, {ImGui::GetContentRegionAvail().x, curve_height}}, curves_of(table), view);
}

/// Which slice of a view.
std::string text_of(double at, double half) { return fmt::format("{:.4g} \xc2\xb1 {:.3g}", at, half); }

}  // namespace

Look look_of(const DebugView& view) {
    return {.black = static_cast<float>(view.low),
            .white = static_cast<float>(view.high),
            .curve = content_of(view) == Content::radiance ? Curve::srgb : Curve::raw};
}

std::string legend_text(const DebugView& view) {
    return fmt::format("black {:g}, white {:g}{}{}", view.low, view.high, view.unit.empty() ? "" : " ", view.unit);
}

void ViewReadouts::take_results(Model& model) {
    if (slice_job_ && slice_job_->result()) {
        const auto slice = **slice_job_->result();
        slice_job_.reset();
        if (!model.image.step && model.image.name == sliced_)
            model.image.made = std::make_shared<MadePicture>(
                MadePicture{sliced_of_, slice, look_of(*find_view(sliced_)), text_of(made_.at, made_.half)});
    }
    if (!waves_job_ || !waves_job_->result()) return;
    const Result<TileWaves>& result = *waves_job_->result();
    if (result) waves_.set(waves_asked_, std::make_shared<TileWaves>(*result));
    else waves_error_ = result.error().sentence;
    waves_job_.reset();
}

void ViewReadouts::draw(Model& model, Services& services, const ViewChoice& choice) {
    Widgets& widgets = services.widgets;
    const auto scope = widgets.in("selected");
    widgets.text("view", fmt::format("{}: {}", choice.technique->name, choice.view->name), &palette().accent);
    ImGui::PushTextWrapPos(0);
    widgets.text("help", choice.view->help);
    ImGui::PopTextWrapPos();
    draw_legend(model, widgets, *choice.view);
    for (const Param* param : params_of(*choice.technique, *choice.view)) draw_param(model, widgets, *choice.technique, *param);
    if (!choice.view->unit.empty()) draw_slice(model, services, choice);
    if (choice.technique->abilities.variants) draw_waves(model, services, choice);
    draw_numbers(model, services, choice);
}

/// Tables and the rows of a pixel are of the views' run, overflows of the picture's.
void ViewReadouts::draw_numbers(const Model& model, Services& services, const ViewChoice& choice) {
    Widgets& widgets = services.widgets;
    const bool is_of_label = services.replayer.is_of("A", model.request()) &&
                             (!choice.found || services.replayer.is_of(choice.made_of, model.request()));
    const auto updating = widgets.updating(updating_word(is_of_label, services.replayer, choice.view->name));
    if (choice.found) draw_pixel(model, widgets, *choice.found);
    if (const auto replay = services.replayer.shown("A")) draw_overflow(widgets, *replay, *choice.technique);
    if (choice.found) draw_tables(widgets, *choice.technique, *choice.found);
}

void ViewReadouts::draw_slice(Model& model, Services& services, const ViewChoice& choice) {
    Widgets& widgets = services.widgets;
    const DebugView& view = *choice.view;
    const std::string output = output_name(*choice.technique, view.name);
    const bool is_on = sliced_ == output;
    if (const auto set = widgets.checkbox("slice", is_on)) {
        sliced_ = *set ? output : "";
        at_ = (view.low + view.high) / 2;
        half_ = (view.high - view.low) / 32;
        made_ = {};
        model.image = {.name = output};
    }
    widgets.help("show only pixels whose (red) value is near the slider's, others black");
    if (sliced_ != output) return;
    const std::string unit(view.unit), format = fmt::format("%.3g {}", unit);
    ImGui::SameLine(label_width);
    ImGui::SetNextItemWidth(-1);
    if (const auto at = widgets.slider("slice at", at_, {.low = view.low, .high = view.high, .format = format.c_str()}))
        at_ = *at;
    widgets.help(fmt::format("the value that is shown, in {}", unit));
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("  give or take");
    ImGui::SameLine(label_width);
    ImGui::SetNextItemWidth(-1);
    const double range = view.high - view.low;
    const SliderRange widths{.low = range / 1024, .high = range, .logarithmic = true, .format = format.c_str()};
    if (const auto half = widgets.slider("slice half", half_, widths)) half_ = *half;
    make_slice(model, services);
}

void ViewReadouts::make_slice(Model& model, Services& services) {
    model.want(sliced_);
    const auto replay = services.replayer.shown("A");
    const auto image = replay ? replay->image(replay, sliced_) : nullptr;
    const Slice wanted{image, at_, half_};
    if (model.image.made) model.image.which_made = text_of(at_, half_);
    if (slice_job_ || !image || (wanted == made_ && model.image.made)) return;
    made_ = wanted;
    sliced_of_ = replay->made_of();
    slice_job_ = start<std::shared_ptr<const HostImage>>(
        services.host, [wanted](ui::Progress&) -> Result<std::shared_ptr<const HostImage>> {
            return std::shared_ptr<const HostImage>(std::make_shared<HostImage>(slice_of(*wanted.image, wanted.at, wanted.half)));
        });
}

void ViewReadouts::start_waves(const Model& model, Services& services, const Technique& technique) {
    if (waves_job_) waves_job_->progress.cancel();
    waves_error_.clear();
    waves_asked_ = {&technique, gpu_, services.replayer.made_of(model.request())};
    const Request request = waves_asked_.made_of.request;
    const ModesOnGpu of{technique, *gpu_, model.program};
    waves_job_ = services.replayer.start<TileWaves>(
        [request, of](Session& session, ui::Progress& progress) { return waves_of_modes(session, progress, request, of); });
}

void ViewReadouts::draw_waves(Model& model, Services& services, const ViewChoice& choice) {
    Widgets& widgets = services.widgets;
    const auto scope = widgets.in("waves");
    std::vector<std::string_view> items{"choose a GPU"};
    const std::vector<const GpuModel*> gpus = compilable_gpus();
    for (const GpuModel* gpu : gpus) items.push_back(gpu->name);
    const auto current = gpu_ ? static_cast<std::size_t>(std::ranges::find(gpus, gpu_) - gpus.begin()) + 1 : 0;
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("waves per SIMD");
    ImGui::SameLine(label_width);
    ImGui::SetNextItemWidth(130);
    const auto chosen = widgets.combo("gpu", items, current);
    widgets.help("waves per SIMD of each tile's shader variant, by Mesa's compiler for a GPU that this machine need not have");
    if (chosen) gpu_ = *chosen == 0 ? nullptr : gpus[*chosen - 1];
    if (chosen && gpu_) start_waves(model, services, *choice.technique);
    if (gpu_) draw_waves_result(model, services, *choice.technique);
}

/// Compiling takes seconds, so waves of other settings stay, under a word that says so, until somebody asks anew.
void ViewReadouts::draw_waves_result(Model& model, Services& services, const Technique& technique) {
    Widgets& widgets = services.widgets;
    const WavesOf now{&technique, gpu_, services.replayer.made_of(model.request())};
    const bool is_asked = waves_asked_ == now && !services.replayer.awaits_shaders();
    if (waves_job_) {
        ImGui::ProgressBar(static_cast<float>(waves_job_->progress.fraction()), {-1, 0}, waves_job_->progress.doing().c_str());
    } else if (!is_asked) {
        ImGui::SameLine();
        if (widgets.button("again", "Again")) start_waves(model, services, technique);
        widgets.help("computes the waves of the present settings");
    }
    ImGui::PushTextWrapPos(0);
    if (is_asked && !waves_error_.empty()) widgets.text("error", waves_error_, &palette().warning);
    ImGui::PopTextWrapPos();
    // Those of another technique or GPU say nothing here.
    if (!waves_.key() || waves_.key()->technique != &technique || waves_.key()->gpu != gpu_) return;
    const bool is_of_label = services.replayer.is_of(waves_.key()->made_of, model.request());
    const auto updating = widgets.updating(is_of_label ? "" : waves_job_ && is_asked ? "updating waves" : "of other settings");
    draw_waves_of(model, widgets, **waves_.value());
}

void ViewReadouts::draw_waves_of(Model& model, Widgets& widgets, const TileWaves& waves) {
    widgets.text("mean", fmt::format("{:.2f} of {} waves per SIMD over {}", waves.mean, gpu_->unit->wave_slots,
                                     plural(waves.tiles, "tile")));
    ImGui::SameLine();
    if (widgets.button("show", "Show"))
        model.image = {
            .name = fmt::format("waves per SIMD on {}", gpu_->name),
            .made = std::make_shared<MadePicture>(MadePicture{
                waves_.key()->made_of,
                std::shared_ptr<const HostImage>(*waves_.value(), &waves.picture),
                {.white = static_cast<float>(gpu_->unit->wave_slots), .channels = Channels::false_color, .curve = Curve::raw}})};
    widgets.help("each tile by the waves of its mode, in Image");
    for (const VariantWaves& variant : waves.variants) {
        const std::string registers = variant.registers ? fmt::format("{:.0f} registers, ", *variant.registers) : "";
        widgets.text(fmt::format("{}", variant.number),
                     fmt::format("{} {}: {}, {}{:g} waves ({})", waves.constant, variant.number, plural(variant.tiles, "tile"),
                                 registers, variant.occupancy.waves_per_simd, name(variant.occupancy.limit)),
                     variant.tiles == 0 ? &palette().dim : &palette().text);
    }
}

void ViewReadouts::draw_tables(Widgets& widgets, const Technique& technique, const TechniqueViews& found) {
    const auto scope = widgets.in("tables");
    for (const auto& [name, table] : found.tables) {
        const std::size_t first = std::min(rows_at_first, table.rows.size());
        const auto of = widgets.in(name);
        widgets.text("name", fmt::format("{}: {}", name, plural(table.rows.size(), "row")), &palette().accent);
        const auto declared = std::ranges::find(technique.tables, name, &DebugTable::name);
        if (declared != technique.tables.end() && declared->is_curves) draw_curves(widgets, table, plots_[name]);
        ImGui::PushTextWrapPos(0);
        for (std::size_t r = 0; r < first; ++r) widgets.text(fmt::format("{}", r), row_text(table, r));
        ImGui::PopTextWrapPos();
        if (first == table.rows.size()) continue;
        const Widgets::TreeRow more = widgets.tree("more", false);
        if (!more.open) continue;
        const std::size_t last = std::min(rows_at_most, table.rows.size());
        for (std::size_t r = first; r < last; ++r) widgets.text(fmt::format("{}", r), row_text(table, r));
        if (last < table.rows.size())
            widgets.text("rest", fmt::format("and {} more: strata replay --outputs", table.rows.size() - last), &palette().dim);
        widgets.tree_end();
    }
}

}  // namespace strata::ui
