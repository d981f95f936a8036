// What a person compares: A and B, which image of them, and when in the frame.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ui/compare/compare_side.h"
#include "ui/picture/picture.h"

namespace strata::ui {

/// "this replay", "truth".
std::string_view name(Source);

struct ChosenSide {
    std::string name;
    Source source;
    ComparedSide picture;
    ShownPicture shown = {};
    const Technique* technique = nullptr;  ///< of a variant
    Settings settings = {};
    std::string file = {};
};

class CompareSides {
public:
    /// The rows of widgets. `replay` is the one of the whole inspector, null at first.
    void draw(Model&, Widgets&, std::shared_ptr<const Replay> replay);
    /// After draw(): wishes for both pictures and takes what came.
    void update(const Model&, Services&);

    const ChosenSide& a() const { return a_; }
    const ChosenSide& b() const { return b_; }
    const std::string& image() const { return image_; }
    /// A truth is one of a stage: the last that writes the image, where nobody chose.
    Subject subject() const;
    bool is_busy() const;
    /// Whether the pictures that are shown are those of A and B as they are chosen.
    bool is_of_choice() const { return is_of_choice_; }
    /// Why a side has no picture.
    std::string trouble() const;

private:
    void draw_side(const Model&, Widgets&, ChosenSide&);
    void draw_variant(const Model&, Widgets&, ChosenSide&) const;
    void draw_subject(Model&, Widgets&);
    void draw_after(const Model&, Widgets&);
    void draw_layer(Model&, Widgets&) const;
    std::string about(const ChosenSide&) const;
    Request request_of(const ChosenSide&, const Model&) const;
    SideWish wish_of(const ChosenSide&, const ChosenSide& other, const Model&) const;

    ChosenSide a_{.name = "A", .source = Source::recorded, .picture = ComparedSide("compare A")};
    ChosenSide b_{.name = "B", .source = Source::replay, .picture = ComparedSide("compare B")};
    std::string image_ = "display";
    std::optional<Stage> after_;
    std::optional<Request> kept_;
    std::shared_ptr<const Replay> replay_;
    bool is_of_choice_ = true;
};

}  // namespace strata::ui
