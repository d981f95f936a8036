// A and B: replays, expectations, truths and files against each other, in pictures and in numbers. B is held against A.
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/compare/compare_canvas.h"
#include "ui/compare/compare_numbers.h"
#include "ui/compare/compare_sides.h"
#include "ui/compare/flip_colors.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

/// Takes seconds for a large picture.
Result<std::shared_ptr<const ComparedPictures>> compared(const PicturePair& pair) {
    return compare(pair).and_then([&](auto& pictures) { return std::make_shared<const ComparedPictures>(std::move(pictures)); });
}

class ComparePanel final : public Panel {
public:
    void draw(Model& model, Services& services) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("Compare");
        drawn_in_ = ImGui::GetFrameCount();
        if (!model.is_known()) return widgets.text("state", "the capture is being opened", &palette().dim);
        sides_.draw(model, widgets, services.replayer.shown("A"));
        update(model, services);
        draw_modes(model, widgets);
        // Each covers all that it is true of: a word stands once.
        const auto of_sides = widgets.updating(word(is_of_choice(services)));
        {
            const auto of_map = widgets.updating(word(!shows_map() || map_is_current()));
            draw_pictures(model, services);
            draw_legend(model, services);
            const auto of_numbers = widgets.updating(word(numbers_are_current()));
            draw_numbers(model, widgets);
        }
        draw_values(model, widgets);
    }

    std::span<const PanelKey> keys() const override;
    /// What nobody looks at is not brought up to date.
    bool is_busy() const override {
        const bool colors = mode_ == CompareMode::flip_map && flip_colors_.is_busy();
        return is_in_front() && (sides_.is_busy() || job_ || colors || (map_index() && maps_[*map_index()].is_busy()));
    }

    void flip(bool to_b) {
        if (!is_in_front()) return;
        mode_ = CompareMode::flip;
        canvas_.flip(to_b);
    }
    bool shows_b() const { return mode_ == CompareMode::flip && canvas_.shows_b(); }

private:
    bool is_in_front() const { return ImGui::GetFrameCount() - drawn_in_ <= 1; }

    void update(const Model& model, Services& services) {
        sides_.update(model, services);
        compare_both(services);
        if (const auto map = map_index()) maps_[*map].show(map_image(), model.image.layer, services.host, services.layer);
        if (mode_ == CompareMode::flip_map) flip_colors_.show(map_image(), scale_end(), services.host, services.layer);
    }

    void compare_both(Services& services) {
        if (job_ && job_->result()) {
            const auto& result = *job_->result();
            compared_ = result ? *result : nullptr;
            message_ = result ? "" : result.error().sentence;
            compared_of_ = job_of_;
            job_.reset();
        }
        const ComparedSide &a = sides_.a().picture, &b = sides_.b().picture;
        const PicturePair pair{sides_.image(), a.picture(), b.picture()};
        if (!pair.a.image || !pair.b.image) {
            compared_.reset();
            compared_images_ = {};
            return;
        }
        // On the way to another subject the sides hold different things for a while.
        if (a.shown()->subject != sides_.subject() || b.shown()->subject != sides_.subject()) return;
        const std::pair images(pair.a.image, pair.b.image);
        if (images == compared_images_) return;
        compared_images_ = images;
        job_of_ = images;
        if (job_) job_->progress.cancel();
        job_ = start<std::shared_ptr<const ComparedPictures>>(services.host, [pair](Progress&) { return compared(pair); });
    }

    bool is_of_choice(const Services& services) const { return sides_.is_of_choice() && !services.replayer.awaits_shaders(); }
    bool shows_map() const { return !shows_pictures() && map_image(); }
    bool map_is_current() const { return numbers_are_current() && maps_[*map_index()].is_current(); }
    bool numbers_are_current() const { return compared_of_ == compared_images_; }
    std::string word(bool is_of_choice) const {
        if (is_of_choice) return {};
        return fmt::format("{} {}: A {}, B {}", sides_.trouble().empty() ? "updating" : "not replayed:", sides_.image(),
                           name(sides_.a().source), name(sides_.b().source));
    }

    /// Which of maps_ is looked at; nothing where pictures are.
    std::optional<std::size_t> map_index() const {
        if (shows_pictures()) return {};
        return static_cast<std::size_t>(mode_) - static_cast<std::size_t>(CompareMode::difference);
    }
    const PictureInfo* map_picture() const { return map_index() ? maps_[*map_index()].picture() : nullptr; }

    std::shared_ptr<const HostImage> map_image() const {
        if (!compared_) return nullptr;
        if (mode_ == CompareMode::relative) return compared_->relative;
        return mode_ == CompareMode::flip_map ? compared_->flip : compared_->difference;
    }

    bool shows_pictures() const { return mode_ <= CompareMode::flip; }

    void draw_modes(Model& model, Widgets& widgets) {
        constexpr std::array<std::string_view, 6> names = {"Wipe", "Side by side", "Flip", "Difference", "Relative", "FLIP"};
        for (std::size_t i = 0; i < names.size(); ++i) {
            const bool is_on = mode_ == static_cast<CompareMode>(i);
            if (is_on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyle().Colors[ImGuiCol_HeaderActive]);
            if (widgets.button(names[i])) mode_ = static_cast<CompareMode>(i);
            if (is_on) ImGui::PopStyleColor();
            widgets.help(mode_help[i]);
            ImGui::SameLine(0, 3);
        }
        ImGui::Dummy({4, 0});
        ImGui::SameLine(0, 3);
        ImGui::SetNextItemWidth(-1);
        if (shows_pictures()) draw_exposure(model, widgets);
        else draw_range(widgets);
    }

    /// Of both pictures alike, and of the image wherever it is shown.
    Look look_of(const Model& model) const {
        const auto own = model.looks.find(sides_.image());
        if (own != model.looks.end()) return own->second;
        const PictureInfo *a = sides_.a().shown.picture(), *b = sides_.b().shown.picture(), *picture = a ? a : b;
        if (!picture) return {};
        Look look = default_look(sides_.image(), *picture);
        // A truth has four channels whatever the image has: that of an image of one number would be red.
        if (b && b->channels() == 1) look.channels = Channels::red;
        return look;
    }

    void draw_exposure(Model& model, Widgets& widgets) const {
        Look look = look_of(model);
        const auto exposure =
            widgets.slider("exposure", double{look.exposure}, {.low = -12, .high = 12, .format = "%+.2f stops"});
        widgets.help("exposure of both pictures; channels, black and white are set in the Image tab");
        if (!exposure) return;
        look.exposure = static_cast<float>(*exposure);
        model.looks[sides_.image()] = look;
    }

    /// Where the scale of a map ends. 999 of 1000 texels lie below what it is by itself.
    double scale_end() const {
        const PictureInfo* map = map_picture();
        const bool is_flip = mode_ == CompareMode::flip_map;
        if (is_flip && flip_gain_) return 1 / *flip_gain_;
        if (mode_ == CompareMode::difference && gain_) return 1 / *gain_;
        if (mode_ == CompareMode::relative && up_to_) return *up_to_;
        if (!map) return 1;
        const double bulk = std::max(std::abs(map->bulk.low), std::abs(map->bulk.high));
        const double end = round_up(bulk > 0 ? bulk : std::max(std::abs(map->range.low), std::abs(map->range.high)));
        return is_flip ? std::min(end, 1.0) : end;
    }

    void draw_range(Widgets& widgets) {
        const bool is_asked = widgets.button("auto", "Auto");
        widgets.help("999 of 1000 texels lie within the scale");
        if (is_asked || ranged_image_ != sides_.image()) {
            gain_.reset();
            flip_gain_.reset();
            up_to_.reset();
            ranged_image_ = sides_.image();
        }
        ImGui::SameLine(0, 3);
        ImGui::SetNextItemWidth(-1);
        if (mode_ == CompareMode::flip_map) {
            const SliderRange range{.low = 1, .high = 1e4, .logarithmic = true, .format = "gain %.4g"};
            if (const auto gain = widgets.slider("flip gain", 1 / scale_end(), range)) flip_gain_ = *gain;
            widgets.help("gain of the FLIP map on the screen; the numbers do not change");
        } else if (mode_ == CompareMode::difference) {
            const SliderRange range{.low = 1e-4, .high = 1e6, .logarithmic = true, .format = "gain %.4g"};
            if (const auto gain = widgets.slider("gain", 1 / scale_end(), range)) gain_ = *gain;
            widgets.help("gain of differences on the screen; the numbers do not change");
        } else {
            const SliderRange range{.low = 1e-4, .high = 1e6, .logarithmic = true, .format = "up to %.4g %%"};
            if (const auto percent = widgets.slider("up to", scale_end() * 100, range)) up_to_ = *percent / 100;
            widgets.help("where the scale ends");
        }
    }

    bool is_signed() const { return compared_ && row(compared_->difference->shape.format).channels == 1; }

    Look map_look() const {
        const auto end = static_cast<float>(scale_end());
        Look look{.white = end, .curve = Curve::raw};
        if (mode_ == CompareMode::flip_map) look.white = 1;
        else if (mode_ == CompareMode::relative || is_signed()) look.channels = Channels::false_color;
        if (mode_ == CompareMode::difference && is_signed()) look.black = -end;
        return look;
    }

    CanvasPicture canvas_picture(const ChosenSide& side, const Model& model) const {
        const std::string& trouble = side.picture.message();
        return {side.picture.picture().image ? side.shown.picture() : nullptr, side.shown.texture(), look_of(model),
                fmt::format("{}  {}{}", side.name, name(side.source), trouble.empty() ? "" : fmt::format(": {}", trouble))};
    }

    void draw_pictures(Model& model, Services& services) {
        ImVec2 size = ImGui::GetContentRegionAvail();
        const float below = 4 * ImGui::GetFrameHeightWithSpacing();
        size = {std::max(size.x, 20.0f), std::max(size.y - below, 20.0f)};
        ComparedView view{
            .mode = mode_, .a = canvas_picture(sides_.a(), model), .b = canvas_picture(sides_.b(), model), .size = size};
        const bool is_flip = mode_ == CompareMode::flip_map;
        if (const PictureInfo* map = map_picture(); map && map_image())
            view.map = {map, is_flip ? flip_colors_.texture() : maps_[*map_index()].texture(), map_look(), map_caption()};
        else view.map.label = is_flip && compared_ ? flip_help(*compared_) : trouble();
        canvas_.draw(view, model, services);
    }

    /// The sentence why there is nothing to be seen.
    std::string trouble() const {
        const std::string of_sides = sides_.trouble();
        return of_sides.empty() ? message_ : of_sides;
    }

    std::string map_caption() const {
        if (mode_ == CompareMode::flip_map)
            return fmt::format("FLIP{}, 0: the same, 1: as different as can be",
                               scale_end() < 1 ? fmt::format(" times {:.4g}", 1 / scale_end()) : "");
        if (mode_ == CompareMode::relative)
            return fmt::format("|B \xe2\x88\x92 A| / max(|A|, RMS of A = {:.3g}), largest channel",
                               compared_->measured.error.reference);
        return fmt::format("{}, {}", is_signed() ? "B \xe2\x88\x92 A" : "|B \xe2\x88\x92 A| per channel", compared_->unit);
    }

    void draw_legend(const Model& model, Services& services) {
        Widgets& widgets = services.widgets;
        if (legend_ == 0) make_legend(services.layer);
        Look look = shows_pictures() ? look_of(model) : map_look();
        const double stops = std::exp2(-double{look.exposure});
        const bool is_flip = mode_ == CompareMode::flip_map;
        const double low = double{look.black} * stops, high = is_flip ? scale_end() : double{look.white} * stops;
        const bool is_relative = mode_ == CompareMode::relative;
        const auto number = [&](double value) {
            return is_relative ? fmt::format("{:.3g} %", value * 100) : fmt::format("{:.3g}", value);
        };
        widgets.text("low", number(low), &palette().dim);
        ImGui::SameLine();
        widgets.canvas("legend", {160, ImGui::GetTextLineHeight()}, fmt::format("{} to {}", number(low), number(high)));
        look.exposure = 0;
        look.black = 0;
        look.white = 1;
        const TextureId ramp = is_flip ? flip_colors_.legend(services.layer) : legend_;
        ImGui::GetWindowDrawList()->AddImage(services.layer.shown(ramp, look), ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
        ImGui::SameLine();
        widgets.text("high", number(high), &palette().dim);
        ImGui::SameLine(0, 12);
        const std::string caption = shows_pictures() ? (compared_ ? compared_->unit : "") : (compared_ ? map_caption() : "");
        widgets.text("caption", caption, &palette().dim);
        widgets.help("magenta: NaN, orange: infinite");
    }

    void make_legend(ImguiLayer& layer) {
        constexpr std::uint32_t steps = 256;
        Texels plain{steps, 1, {}};
        for (std::uint32_t i = 0; i < steps; ++i) {
            const auto share = static_cast<float>(i) / (steps - 1);
            plain.rgba.insert(plain.rgba.end(), {share, share, share, 1});
        }
        legend_ = layer.upload(0, plain);
    }

    void draw_numbers(Model& model, Widgets& widgets) {
        const std::string why = trouble();
        if (!compared_)
            return widgets.text("state", why.empty() ? "being compared" : why, why.empty() ? &palette().dim : &palette().bad);
        if (compared_->measured.error.identical) {
            widgets.text("state", "bit for bit the same", &palette().good);
        } else {
            widgets.text("flip mean", flip_text(*compared_));
            widgets.help(flip_help(*compared_));
            ImGui::SameLine(0, 14);
            widgets.text("rmse", rmse_text(*compared_));
            widgets.help(fmt::format("root mean square over all values of all layers, {}; A's own is {:.4g}", compared_->unit,
                                     compared_->measured.error.reference));
            ImGui::SameLine(0, 14);
            if (widgets.button("worst", worst_text(*compared_))) go_to_worst(model);
            widgets.help(fmt::format("{:.9g} in A, {:.9g} in B; a click goes there", compared_->measured.error.worst_pixel.a,
                                     compared_->measured.error.worst_pixel.b));
        }
        const std::string odd = oddities_text(*compared_);
        widgets.text("differing", differing_text(*compared_), &palette().dim);
        if (odd.empty()) return;
        ImGui::SameLine(0, 14);
        widgets.text("oddities", odd, &palette().warning);
    }

    void go_to_worst(Model& model) {
        const WorstPixel& worst = compared_->measured.error.worst_pixel;
        model.pin = glm::ivec2(static_cast<int>(worst.x), static_cast<int>(worst.y));
        model.image.layer = worst.layer;
        canvas_.go_to(model.view, *model.pin);
    }

    /// Of the texel under the mouse, else of the pinned one.
    void draw_values(const Model& model, Widgets& widgets) const {
        const auto at = canvas_.under() ? canvas_.under() : model.pin;
        const PictureInfo *a = sides_.a().shown.picture(), *b = sides_.b().shown.picture();
        if (!at || !a || !b || !a->contains(*at) || !b->contains(*at)) return;
        const bool is_pin = !canvas_.under();
        widgets.text("values",
                     fmt::format("{} {} {}   A  {}   B  {}", is_pin ? "\xe2\x8a\x95" : " ", at->x, at->y, values_text(*a, *at),
                                 values_text(*b, *at)),
                     is_pin ? &palette().accent : nullptr);
    }

    static constexpr std::array<std::string_view, 6> mode_help = {
        "A left of the divider, B right of it; drag the divider",
        "both side by side, moved together",
        "A and B in turn: Space",
        "difference B - A, times a gain",
        "errors relative to A",
        "difference that a person sees when flipping between both (FLIP, 2020 and 2021)",
    };

    CompareSides sides_;
    std::string message_, ranged_image_;
    JobOf<std::shared_ptr<const ComparedPictures>> job_;
    std::pair<std::shared_ptr<const HostImage>, std::shared_ptr<const HostImage>> compared_images_;
    std::shared_ptr<const ComparedPictures> compared_;
    std::pair<std::shared_ptr<const HostImage>, std::shared_ptr<const HostImage>> job_of_, compared_of_;  ///< made of these
    std::array<ShownPicture, 3> maps_;  ///< difference, relative, FLIP
    FlipColors flip_colors_;
    std::optional<double> gain_, flip_gain_, up_to_;
    TextureId legend_ = 0;
    CompareMode mode_ = CompareMode::wipe;
    CompareCanvas canvas_;
    int drawn_in_ = -2;
};

template <bool to_b>
void show_side(Panel& panel, Model&, Services&) {
    static_cast<ComparePanel&>(panel).flip(to_b);
}

std::span<const PanelKey> ComparePanel::keys() const {
    static constexpr PanelKey table[] = {
        {"space", "flip between A and B",
         [](Panel& panel, Model&, Services&) {
             auto& self = static_cast<ComparePanel&>(panel);
             self.flip(!self.shows_b());
         }},
        {"a", "show A", show_side<false>},
        {"b", "show B", show_side<true>},
    };
    return table;
}

}  // namespace

std::unique_ptr<Panel> compare_panel() { return std::make_unique<ComparePanel>(); }

}  // namespace strata::ui
