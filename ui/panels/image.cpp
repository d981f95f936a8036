// Any output of any step and every view of every technique, texel by texel.
#include <algorithm>
#include <array>

#include "replay/plural.h"
#include "ui/panel.h"
#include "ui/picture/camera.h"
#include "ui/picture/eye_lag.h"
#include "ui/picture/legend.h"
#include "ui/picture/outline.h"
#include "ui/picture/outputs.h"
#include "ui/picture/picture_view.h"
#include "ui/picture/save_shown.h"
#include "ui/replayer/live_query.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

struct Peek {
    Request request;
    ImageChoice image;
    friend bool operator==(const Peek&, const Peek&) = default;
};

/// What is to be seen, and whether it is what the list says.
struct WantedImage {
    std::shared_ptr<const HostImage> image = nullptr;
    bool is_of_label = false;
    MadeOf made_of = {};
};

class ImagePanel final : public Panel {
public:
    void draw(Model& model, Services& services) override {
        const auto scope = services.widgets.in("Image");
        const WantedImage wanted = wanted_image(model, services);
        shown_.show(wanted.image, model.image.layer, services.host, services.layer);
        const PictureInfo* picture = shown_.picture();
        if (wanted.image && shown_.is_current()) {
            shown_of_ = wanted.made_of;
            shown_name_ = model.image.name;
            shown_step_ = model.image.step;
            if (model.image.made) made_look_ = model.image.made->look;
            else made_look_.reset();
        }
        if (picture) default_ = made_look_ ? *made_look_ : default_look(shown_name_, *picture);
        const std::string word = word_over(model, services, wanted);
        const Widgets::Veil veil = veil_of(model, services);
        take_saved(services);
        draw_choice(model, services.widgets, picture);
        if (picture) draw_size(services.widgets, *picture, word.empty() || veil == Widgets::Veil::held_back);
        ImGui::BeginDisabled(!is_of_name(model));  // they would change another picture's look than the one they show
        {
            const auto updating = services.widgets.updating(word.empty() ? "" : "updating", veil);
            draw_look(model, services.widgets, picture);
        }
        ImGui::EndDisabled();
        draw_eye(model, services.widgets);
        const auto updating = services.widgets.updating(word, veil);
        draw_canvas(model, services, picture);
        const auto of_numbers = services.widgets.updating(word);
        draw_line(model, services.widgets, picture);
        model.under = under_;
    }

    bool is_busy() const override { return shown_.is_busy() || peeked_.progress() || (saved_ && !saved_->result()); }

    std::span<const PanelKey> keys() const override;

    void nudge(Model& model, glm::ivec2 by) const {
        if (!model.pin || !shown_.picture()) return;
        const Texels& texels = shown_.picture()->texels;
        model.pin = glm::clamp(*model.pin + by, glm::ivec2(0), glm::ivec2(texels.width, texels.height) - 1);
    }
    void zoom(Model& model, double factor) const {
        if (shown_.picture()) zoom_by(model.view, placement_, factor);
    }
    /// What is shown into the folder the inspector was started in.
    void save_shown(const Model& model, Services& services) {
        const auto replay = services.replayer.shown("A");
        const CaptureFacts* facts = services.replayer.facts();
        if (saved_ || !replay || !facts || !shown_.picture()) return;
        const ShownImage shown{shown_name_, shown_.picture()->image, shown_.picture()->layer, look_of(model), {}};
        const std::string stem = stem_of(model.capture, replay->request.variant.frame, shown.name),
                          command = model.command_line();
        saved_ = start<std::filesystem::path>(services.host, [=, of = *facts, image = model.image](ui::Progress&) {
            ShownImage traced = shown;
            traced.provenance = provenance({of.device, of.id}, replay->request, replay->run);
            traced.provenance["strata.command"] = command;
            if (image.step) traced.provenance["strata.step"] = std::to_string(*image.step);
            if (image.made) traced.provenance["strata.made"] = "by a panel, of the image of that name";
            return save(std::filesystem::current_path(), stem, traced);
        });
    }
    void change_exposure(Model& model, float stops) {
        Look look = look_of(model);
        look.exposure += stops;
        set_look(model, look);
    }
    void fit_range(Model& model) {
        const PictureInfo* picture = shown_.picture();
        if (!picture || picture->bulk.high <= picture->bulk.low) return;
        Look look = look_of(model);
        look.exposure = 0;
        look.black = static_cast<float>(picture->bulk.low);
        look.white = static_cast<float>(picture->bulk.high);
        set_look(model, look);
    }
    /// The next of the ways to show channels.
    void cycle_channels(Model& model) {
        Look look = look_of(model);
        look.channels = static_cast<Channels>((static_cast<std::uint32_t>(look.channels) + 1) % 7);
        set_look(model, look);
    }

private:
    WantedImage wanted_image(Model& model, Services& services) {
        const auto replay = services.replayer.shown("A");
        message_.clear();
        if (const Error* error = services.replayer.open_error()) message_ = error->sentence;
        if (const auto& made = model.image.made) {
            if (replay && made->of != replay->made_of())
                message_ = "this picture shows an earlier replay; update it in the panel that made it";
            return {made->image, services.replayer.is_of(made->of, model.request()) && made->which == model.image.which_made,
                    made->of};
        }
        if (!model.image.step) {
            peeked_.withdraw();
            model.want(model.image.name);
            if (!replay) return {};
            auto image = replay->image(replay, model.image.name);
            if (!image && services.replayer.is_current("A") && !services.replayer.error("A"))
                message_ = fmt::format("this frame has no '{}'", model.image.name);
            return {std::move(image), services.replayer.is_of("A", model.request()), replay->made_of()};
        }
        return replay ? peeked_image(model, services, *replay) : WantedImage();
    }

    /// What a step wrote, asked of the device once per replay.
    WantedImage peeked_image(const Model& model, Services& services, const Replay& replay) {
        Peek peek{replay.request, model.image};
        peek.image.layer = 0;  // all of them come at once
        peeked_.ask(services.replayer, peek,
                    [](Session& session, Progress&, const Peek& of) -> Result<std::shared_ptr<const HostImage>> {
                        return session.peek(of.request, *of.image.step, of.image.name).and_then([&](auto& image) {
                            return std::make_shared<const HostImage>(std::move(image));
                        });
                    });
        message_ = peeked_.error();
        // Of another step, or of the replay before: no picture of this one.
        if (!peeked_.is_answered(services.replayer, peek)) return {};
        return {*peeked_.answer(), services.replayer.is_of("A", model.request()), replay.made_of()};
    }

    bool is_of_name(const Model& model) const { return shown_name_ == model.image.name && shown_step_ == model.image.step; }

    /// A picture has the key of its image: which replay, which of its images, which layer.
    std::string word_over(const Model& model, const Services& services, const WantedImage& wanted) const {
        if (!shown_.picture()) return {};
        const bool is_of_label = wanted.image && wanted.is_of_label && shown_.is_current() && is_of_name(model);
        const auto& made = model.image.made;
        // Its panel makes it anew, while it is in front and if nobody has to ask for it.
        if (made && services.replayer.is_of("A", model.request()) && !services.replayer.is_of(made->of, model.request()))
            return fmt::format("of an earlier replay: {}", model.image.name);
        return updating_word(is_of_label, services.replayer, model.image.name);
    }

    /// Held back while somebody flies, unless the numbers of texels are to be read.
    Widgets::Veil veil_of(const Model& model, const Services& services) {
        lag_.note(services.replayer.made_of(model.request()), shown_of_, services.seconds);
        const bool is_held_back = lag_.is_small() && is_of_name(model) && !services.replayer.awaits_shaders() &&
                                  !model.image.made && !shows_numbers(placement_);
        return is_held_back ? Widgets::Veil::held_back : Widgets::Veil::drawn;
    }

    /// Of the picture that is shown, whatever is chosen meanwhile.
    Look look_of(const Model& model) const {
        const auto own = model.looks.find(shown_name_);
        return own == model.looks.end() ? default_ : own->second;
    }
    /// Of it, too: a key may come while another picture is on its way, whose look is its own.
    void set_look(Model& model, const Look& look) const {
        if (look == default_) model.looks.erase(shown_name_);
        else model.looks[shown_name_] = look;
    }

    static std::string made_text(const ImageChoice& image) {
        return fmt::format("made: {}{}{}", image.name, image.which_made.empty() ? "" : ", ", image.which_made);
    }

    static void draw_choice(Model& model, Widgets& widgets, const PictureInfo* picture) {
        const std::vector<std::string> outputs = outputs_of(model);
        std::vector<std::string_view> items(outputs.begin(), outputs.end());
        const std::string own = model.image.step   ? fmt::format("step {}: {}", *model.image.step, model.image.name)
                                : model.image.made ? made_text(model.image)
                                                   : "";
        if (!own.empty()) items.insert(items.begin(), own);
        const auto current =
            !own.empty() ? 0 : static_cast<std::size_t>(std::ranges::find(items, model.image.name) - items.begin());
        ImGui::SetNextItemWidth(230);
        if (const auto chosen = widgets.combo("image", items, current)) {
            model.image = {.name = std::string(items[*chosen])};
            model.step.reset();
        }
        const std::uint32_t layers = picture ? picture->image->shape.layers * picture->image->shape.extent.depth : 1;
        if (layers > 1) {
            ImGui::SameLine();
            ImGui::SetNextItemWidth(110);
            const auto layer = widgets.slider("layer", model.image.layer, {.high = layers - 1.0, .whole = true});
            if (layer) model.image.layer = static_cast<std::uint32_t>(*layer);
            widgets.help("layer of this image: a sample, a slice or a shadow map");
        }
        ImGui::SameLine();
        if (widgets.button("fit", "Fit")) model.view = {};
        widgets.help("F, or double click");
        ImGui::SameLine();
        const bool one_to_one = widgets.button("100 %", "1:1");
        if (one_to_one && picture) model.view = {1, picture->texels.width / 2.0, picture->texels.height / 2.0};
        widgets.help("a pixel per texel");
    }

    void draw_look(Model& model, Widgets& widgets, const PictureInfo* picture) {
        constexpr std::array<std::string_view, 7> channels = {"RGB", "R", "G", "B", "A", "Luminance", "False color"};
        Look look = look_of(model);
        ImGui::SetNextItemWidth(104);
        if (const auto chosen = widgets.combo("channels", channels, static_cast<std::size_t>(look.channels)))
            look.channels = static_cast<Channels>(*chosen);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(120);
        const auto exposure =
            widgets.slider("exposure", double{look.exposure}, {.low = -12, .high = 12, .format = "%+.2f stops"});
        if (exposure) look.exposure = static_cast<float>(*exposure);
        widgets.help("exposure; E and Shift+E");
        ImGui::SameLine();
        draw_histogram(widgets, picture, look);
        ImGui::SameLine();
        if (widgets.button("auto", "Auto")) return fit_range(model);
        widgets.help("set black and white to the range of the image without its outermost 0.1 %");
        ImGui::SameLine();
        constexpr std::array<std::string_view, 2> curves = {"raw", "sRGB"};
        ImGui::SetNextItemWidth(68);
        if (const auto curve = widgets.combo("curve", curves, static_cast<std::size_t>(look.curve)))
            look.curve = static_cast<Curve>(*curve);
        widgets.help("display curve: linear, or sRGB for light");
        ImGui::SameLine();
        ImGui::BeginDisabled(look == default_);
        if (widgets.button("reset look", "\xe2\x86\xba")) look = default_;
        ImGui::EndDisabled();
        if (look != look_of(model)) set_look(model, look);
    }

    /// Black and white are pulled in the histogram: left button the one, right button the other.
    static void draw_histogram(Widgets& widgets, const PictureInfo* picture, Look& look) {
        const float width = std::max(60.0f, ImGui::GetContentRegionAvail().x - 190), height = ImGui::GetFrameHeight();
        widgets.canvas("range", {width, height}, fmt::format("{:g} to {:g}", look.black, look.white));
        const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(from, to, ImGui::GetColorU32(ImGuiCol_FrameBg), 3);
        if (!picture) return;
        // The whole range and what the look makes of it, both in sight.
        const double low = std::min(picture->range.low, double{look.black}),
                     high = std::max({picture->range.high, double{look.white}, low + 1e-9});
        const auto x_of = [&](double value) { return from.x + static_cast<float>((value - low) / (high - low)) * width; };
        draw_bars(list, *picture, {x_of(picture->range.low), from.y}, {x_of(picture->range.high), to.y});
        for (const double value : {double{look.black}, double{look.white}})
            list.AddLine({x_of(value), from.y}, {x_of(value), to.y}, packed(palette().accent), 2);
        const double under = low + double{(ImGui::GetIO().MousePos.x - from.x) / width} * (high - low);
        if (ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left))
            look.black = static_cast<float>(std::min(under, double{look.white} - 1e-6));
        if (ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Right))
            look.white = static_cast<float>(std::max(under, double{look.black} + 1e-6));
        widgets.help(fmt::format("{:g} to {:g} shown of {:g} to {:g}\nleft button sets black, right button white", look.black,
                                 look.white, picture->range.low, picture->range.high));
    }

    static void draw_bars(ImDrawList& list, const PictureInfo& picture, ImVec2 from, ImVec2 to) {
        std::uint32_t most = 1;
        for (const auto& channel : picture.histogram)
            for (std::size_t i = 1; i + 1 < PictureInfo::bins; ++i) most = std::max(most, channel[i]);
        constexpr std::array<ImU32, 3> colors = {IM_COL32(230, 90, 90, 130), IM_COL32(90, 210, 110, 130),
                                                 IM_COL32(90, 130, 240, 130)};
        const float width = (to.x - from.x) / static_cast<float>(PictureInfo::bins);
        for (std::uint32_t c = 0; c < std::min(picture.channels(), 3u); ++c)
            for (std::size_t i = 0; i < PictureInfo::bins; ++i) {
                const float share = std::min(1.0f, static_cast<float>(picture.histogram[c][i]) / static_cast<float>(most));
                if (share <= 0) continue;
                const float x = from.x + static_cast<float>(i) * width;
                list.AddRectFilled({x, to.y - std::max(1.0f, share * (to.y - from.y - 2))}, {x + std::max(width, 1.0f), to.y},
                                   picture.channels() == 1 ? IM_COL32(200, 200, 200, 160) : colors[c]);
            }
    }

    static void draw_eye(Model& model, Widgets& widgets) {
        const std::string eye = text(model.edits().variant.eye);
        if (eye.empty()) return;
        ImGui::AlignTextToFramePadding();
        widgets.text("eye", "\xe2\x97\x8e camera moved: expected results are not compared", &palette().warning);
        widgets.help(fmt::format("offset from the recorded camera in meters and radians: {}", eye));
        ImGui::SameLine();
        if (widgets.button("recorded eye", "Back")) model.look_from({});
        widgets.help("Home");
    }

    void take_saved(Services& services) {
        if (!saved_ || !saved_->result()) return;
        const Result<std::filesystem::path>& path = *saved_->result();
        if (path)
            services.log.push_back(
                {LogLine::Kind::said, services.seconds, fmt::format("saved {}.exr, .png and .json", path->string())});
        else services.log.push_back({LogLine::Kind::failed, services.seconds, path.error().sentence});
        saved_.reset();
    }

    void draw_canvas(Model& model, Services& services, const PictureInfo* picture) {
        ImVec2 size = ImGui::GetContentRegionAvail();
        size.y = std::max(size.y - ImGui::GetTextLineHeightWithSpacing(), 20.0f);
        size.x = std::max(size.x, 20.0f);
        services.widgets.canvas("picture", size, model.image.name);
        const ImVec2 from = ImGui::GetItemRectMin();
        ImGui::GetWindowDrawList()->AddRectFilled(from, {from.x + size.x, from.y + size.y}, IM_COL32(14, 15, 18, 255));
        under_.reset();
        if (picture) {
            placement_ = place(model.view, from, size, picture->texels);
            take_mouse(model, services, *picture);
            draw_picture(services.layer, placement_, shown_.texture(), look_of(model));
            draw_details(placement_, *picture);
            if (model.outline) draw_outline(placement_, *model.outline, model.request());
            if (model.pin && picture->contains(*model.pin)) draw_pin(placement_, *model.pin);
            if (!shown_step_) draw_legend_over(services.widgets, placement_, look_of(model), shown_name_);
        }
        if (message_.empty()) return;
        const ImVec2 text = ImGui::CalcTextSize(message_.c_str(), nullptr, false, size.x - 20);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled({from.x + 6, from.y + 6}, {from.x + text.x + 22, from.y + text.y + 16}, IM_COL32(20, 22, 27, 230), 4);
        list.AddText(nullptr, 0, {from.x + 14, from.y + 11}, packed(palette().warning), message_.c_str(), nullptr, size.x - 20);
    }

    void take_mouse(Model& model, const Services& services, const PictureInfo& picture) {
        camera_.move(model, services, placement_);
        const glm::ivec2 texel = placement_.texel_at(mouse_point());
        if (ImGui::IsItemHovered() && picture.contains(texel)) under_ = texel;
        const bool was_click = !camera_.is_held() && ImGui::IsItemDeactivated() &&
                               ImGui::IsMouseReleased(ImGuiMouseButton_Left) && ImGui::GetIO().MouseDragMaxDistanceSqr[0] < 9;
        if (was_click && picture.contains(texel)) model.pin = texel;
        const bool stays = ImGui::GetIO().MouseDragMaxDistanceSqr[ImGuiMouseButton_Right] < 9;
        if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Right) && stays) model.pin.reset();
        if (!camera_.is_held()) move_by_mouse(model.view, placement_);
        placement_ = place(model.view, placement_.from,
                           {placement_.to.x - placement_.from.x, placement_.to.y - placement_.from.y}, picture.texels);
    }

    void draw_line(const Model& model, Widgets& widgets, const PictureInfo* picture) const {
        if (!picture) {
            widgets.text("state", "nothing replayed yet", &palette().dim);
            return;
        }
        const bool has_pin = model.pin && picture->contains(*model.pin);
        if (has_pin)
            widgets.text("pinned", fmt::format("pin {} {}:  {}", model.pin->x, model.pin->y, values_text(*picture, *model.pin)),
                         &palette().accent);
        else widgets.text("hint", under_ ? "" : "click pins a pixel, right click unpins it; the wheel zooms", &palette().dim);
        if (!under_) return;
        ImGui::SameLine(0, has_pin ? 14 : 0);
        widgets.text("under", fmt::format("{} {}:  {}", under_->x, under_->y, values_text(*picture, *under_)));
    }

    void draw_size(Widgets& widgets, const PictureInfo& picture, bool is_of_label) const {
        if (!is_of_label) return;
        ImGui::SameLine(0, 12);
        widgets.text("size",
                     fmt::format("{} x {}  {}  {:.0f} %", picture.texels.width, picture.texels.height,
                                 row(picture.image->shape.format).name, placement_.zoom * 100),
                     &palette().dim);
        if (picture.nans + picture.infinities == 0) return;
        ImGui::SameLine(0, 12);
        widgets.text("not numbers", fmt::format("{} NaN, {} infinite", picture.nans, picture.infinities), &palette().bad);
    }

    ShownPicture shown_;
    std::string shown_name_ = "display", message_;
    Look default_;
    std::optional<std::size_t> shown_step_;
    MadeOf shown_of_;
    EyeLag lag_;
    std::optional<Look> made_look_;
    LiveQuery<Peek, std::shared_ptr<const HostImage>> peeked_;
    JobOf<std::filesystem::path> saved_;
    Camera camera_;
    Placement placement_;
    std::optional<glm::ivec2> under_;
};

template <int x, int y>
void nudge_pin(Panel& panel, Model& model, Services&) {
    static_cast<ImagePanel&>(panel).nudge(model, {x, y});
}
template <int stops>
void expose(Panel& panel, Model& model, Services&) {
    static_cast<ImagePanel&>(panel).change_exposure(model, static_cast<float>(stops) / 2);
}

std::span<const PanelKey> ImagePanel::keys() const {
    static constexpr PanelKey table[] = {
        {"f", "the whole picture", [](Panel&, Model& model, Services&) { model.view = {}; }},
        {"plus", "larger", [](Panel& panel, Model& model, Services&) { static_cast<ImagePanel&>(panel).zoom(model, 2); },
         WhileHeld::repeats},
        {"minus", "smaller", [](Panel& panel, Model& model, Services&) { static_cast<ImagePanel&>(panel).zoom(model, .5); },
         WhileHeld::repeats},
        {"e", "half a stop brighter", expose<1>, WhileHeld::repeats},
        {"shift+e", "half a stop darker", expose<-1>, WhileHeld::repeats},
        {"n", "black and white by the image's own range",
         [](Panel& panel, Model& model, Services&) { static_cast<ImagePanel&>(panel).fit_range(model); }},
        {"c", "other channels",
         [](Panel& panel, Model& model, Services&) { static_cast<ImagePanel&>(panel).cycle_channels(model); }},
        {"left", "move the pinned pixel", nudge_pin<-1, 0>, WhileHeld::repeats},
        {"right", "move the pinned pixel", nudge_pin<1, 0>, WhileHeld::repeats},
        {"up", "move the pinned pixel", nudge_pin<0, -1>, WhileHeld::repeats},
        {"down", "move the pinned pixel", nudge_pin<0, 1>, WhileHeld::repeats},
        {"f12", "save what is shown as EXR and PNG, and its provenance as JSON",
         [](Panel& panel, Model& model, Services& services) { static_cast<ImagePanel&>(panel).save_shown(model, services); }},
        {"d", "the displayed picture", [](Panel&, Model& model, Services&) { model.image = {}; }},
    };
    return table;
}

}  // namespace

std::unique_ptr<Panel> image_panel() { return std::make_unique<ImagePanel>(); }

}  // namespace strata::ui
