#include "replay/difference/page/difference_page.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "capture_format/export/png.h"
#include "replay/difference/picture.h"
#include "replay/markup_text.h"
#include "replay/page_parts.h"
#include "replay/plural.h"
#include "replay/tables/cell.h"
#include "replay/tables/shown_columns.h"

namespace strata {
namespace {

// Pictures that are kept until it is known which of them fit.
constexpr std::size_t most_kept = 8 * page_picture_bytes;

struct Pixels {
    int width = 0, height = 0;
    std::vector<Rgb> rgb;
};

Rgb pixel(const Canvas& canvas, int x, int y) {
    return canvas.pixels()[std::size_t(y) * std::size_t(canvas.width()) + std::size_t(x)];
}

/// Blocks of texels as one pixel each: their mean, or the brightest, so that no single texel that differs is lost.
Pixels shrunk(const Canvas& canvas, int by, bool is_difference) {
    Pixels made{(canvas.width() + by - 1) / by, (canvas.height() + by - 1) / by, {}};
    for (int y = 0; y < made.height; ++y)
        for (int x = 0; x < made.width; ++x) {
            glm::ivec3 sum(0), brightest(0);
            int count = 0;
            for (int v = y * by; v < std::min((y + 1) * by, canvas.height()); ++v)
                for (int u = x * by; u < std::min((x + 1) * by, canvas.width()); ++u) {
                    const glm::ivec3 texel(pixel(canvas, u, v));
                    sum += texel, ++count;
                    if (texel.x + texel.y + texel.z > brightest.x + brightest.y + brightest.z) brightest = texel;
                }
            made.rgb.emplace_back(is_difference ? brightest : sum / count);
        }
    return made;
}

Pixels cut(const Canvas& canvas, const Box& box) {
    Pixels made{box.width, box.height, {}};
    for (int y = box.y; y < box.y + box.height; ++y)
        for (int x = box.x; x < box.x + box.width; ++x) made.rgb.push_back(pixel(canvas, x, y));
    return made;
}

std::vector<std::byte> png_of(const Pixels& pixels) {
    return encode_png(std::uint32_t(pixels.width), std::uint32_t(pixels.height), 3, std::as_bytes(std::span(pixels.rgb)));
}

/// Transparent where both are alike: a page shows it over the other.
std::vector<std::byte> png_over(const Pixels& shown, const Pixels& below) {
    std::vector<glm::u8vec4> rgba(shown.rgb.size(), glm::u8vec4(0));
    for (std::size_t i = 0; i < rgba.size(); ++i)
        if (shown.rgb[i] != below.rgb[i]) rgba[i] = glm::u8vec4(shown.rgb[i], 255);
    return encode_png(std::uint32_t(shown.width), std::uint32_t(shown.height), 4, std::as_bytes(std::span(rgba)));
}

/// Around the worst pixel, inside the image.
Box detail_box(const WorstPixel& worst, const Canvas& canvas) {
    const auto edge = static_cast<int>(page_detail_edge);
    const int width = std::min(edge, canvas.width()), height = std::min(edge, canvas.height());
    return {std::clamp(static_cast<int>(worst.x) - width / 2, 0, canvas.width() - width),
            std::clamp(static_cast<int>(worst.y) - height / 2, 0, canvas.height() - height), width, height};
}

/// Limits as people read them.
std::string limits_text(const ErrorLimits& limits) {
    std::vector<std::string> each;
    if (limits.flip_mean) each.push_back(fmt::format("mean FLIP of light up to {:g}", *limits.flip_mean));
    if (!limits.flip_mean || limits.limit)
        each.push_back(fmt::format("up to {:g} % of the pixels off by more than {:g}", limits.percent, limits.limit.value_or(0)));
    if (limits.region)
        each.push_back(fmt::format("up to {:g} % of any {} x {} pixels", *limits.region, region_block, region_block));
    if (limits.hard_limit < ErrorLimits::none) each.push_back(fmt::format("no pixel by more than {:g}", limits.hard_limit));
    if (limits.ulps > 0) each.push_back(fmt::format("depth up to {}", plural(limits.ulps, "ULP")));
    if (!limits.images.empty()) each.push_back(fmt::format("of {}", fmt::join(limits.images, ", ")));
    if (!limits.ignored.boxes.empty()) each.push_back(plural(limits.ignored.boxes.size(), "box") + " ignored");
    if (!limits.ignored.mask.empty())
        each.push_back(plural(std::size_t(std::ranges::count(limits.ignored.mask, true)), "pixel") + " ignored by a mask");
    return fmt::format("{}", fmt::join(each, "; "));
}

std::string side_text(const Side& side) {
    std::vector<std::string> each{side.name};
    if (!side.asked.empty()) each.push_back(side.asked);
    if (!side.capture.empty()) each.push_back("capture " + side.capture);
    if (!side.device.empty()) each.push_back(fmt::format("{} ({})", side.device, side.driver));
    return fmt::format("{}", fmt::join(each, ", "));
}

/// "transparency: color"; of files the image alone.
std::string divergence_text(const Divergence& first) {
    return (first.pass == label_of_files ? "" : first.pass + ": ") + first.image;
}

/// An image of a pass of a frame.
struct Place {
    const FrameComparison* frame;
    const PassComparison* pass;
    const ImageComparison* image;
    bool is_first;  ///< that is over tolerance in its frame
};

/// The parts of a page; each fills a place of difference.html.
class DifferencePage {
public:
    DifferencePage(const Comparison& comparison, const PagePictures& pictures) : comparison_(comparison), pictures_(pictures) {
        for (const FrameComparison& frame : comparison.frames)
            for (const PassComparison& pass : frame.passes)
                for (const ImageComparison& image : pass.images)
                    places_.push_back(
                        {&frame, &pass, &image, frame.divergence.pass == pass.label && frame.divergence.image == image.image});
        std::vector<const Place*> order;
        order.reserve(places_.size());
        for (const Place& place : places_) order.push_back(&place);
        std::ranges::stable_sort(
            order, {}, [](const Place* place) { return std::tuple(!place->is_first, -static_cast<int>(place->image->verdict)); });
        std::size_t bytes = 0;
        for (const Place* place : order) {
            const auto* shown = shown_of(*place);
            if (!shown || (bytes + shown->bytes) * 4 / 3 > page_picture_bytes) continue;
            bytes += shown->bytes;
            fitting_.insert(place);
        }
    }

    std::string text() const {
        return filled(difference_html, {{"title", escaped(fmt::format("{} | {}", comparison_.a.name, comparison_.b.name))},
                                        {"css", std::string(plot_css) + std::string(page_css)},
                                        {"own_css", std::string(difference_css)},
                                        {"provenance", provenance()},
                                        {"verdict", escaped(verdict_text())},
                                        {"facts", facts()},
                                        {"command", escaped(comparison_.rerun)},
                                        {"heading", escaped(heading())},
                                        {"articles", articles()},
                                        {"table", table()},
                                        {"text", escaped(as_text(comparison_))},
                                        {"pages_js", std::string(pages_js)},
                                        {"js", std::string(difference_js)}});
    }

private:
    const PagePictures::Shown* shown_of(const Place& place) const {
        return pictures_.find(case_name(place.frame->frame, *place.pass, *place.image));
    }

    std::string provenance() const {
        std::string text;
        for (const std::string& part :
             {plural(comparison_.frames.size(), "frame"), plural(places_.size(), "image"), comparison_.tool, comparison_.date})
            text += fmt::format("<span>{}</span>", escaped(part));
        return text;
    }

    std::size_t count(Verdict verdict) const {
        return std::size_t(std::ranges::count_if(places_, [=](const Place& place) { return place.image->verdict == verdict; }));
    }

    std::string verdict_text() const {
        switch (verdict(comparison_)) {
            case Verdict::same:
                return "The same, bit for bit";
            case Verdict::not_compared:
            case Verdict::within:
                return "Every difference is within the limits";
            case Verdict::warning:
                return fmt::format("Within the limits, with {}", plural(count(Verdict::warning), "warning"));
            case Verdict::over:
                break;
        }
        const auto frame =
            std::ranges::find_if(comparison_.frames, [](const FrameComparison& each) { return !each.divergence.pass.empty(); });
        return fmt::format("Over tolerance: {} differs first{}", divergence_text(frame->divergence),
                           comparison_.frames.size() > 1 ? fmt::format(", in frame {}", frame->frame) : "");
    }

    std::string facts() const {
        std::string text;
        const auto add = [&](std::string_view head, const std::string& fact) {
            text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", head, escaped(fact));
        };
        add("A", side_text(comparison_.a));
        add("B", side_text(comparison_.b));
        add("allowed", limits_text(comparison_.limits));
        add("images",
            fmt::format("{} over tolerance, {} with a warning, {} within, {} the same, {} not compared", count(Verdict::over),
                        count(Verdict::warning), count(Verdict::within), count(Verdict::same), count(Verdict::not_compared)));
        std::size_t told = 0, diverge = 0;
        constexpr std::size_t most_told = 5;
        for (const FrameComparison& frame : comparison_.frames) {
            if (frame.divergence.pass.empty()) continue;
            if (++diverge > most_told) continue;
            ++told;
            const std::string step = frame.divergence.step.empty() ? "" : "; " + frame.divergence.step;
            add(fmt::format("frame {}", frame.frame), divergence_text(frame.divergence) + step);
        }
        for (const FrameComparison& frame : comparison_.frames)
            for (const std::string& note : frame.notes) add(fmt::format("frame {}", frame.frame), note);
        if (diverge > told) add("frames", plural(diverge - told, "more frame") + " over tolerance");
        return text;
    }

    std::string heading() const {
        const std::size_t differing = places_.size() - count(Verdict::same) - count(Verdict::not_compared);
        return differing == 0 ? "Nothing differs" : plural(differing, "image") + (differing == 1 ? " differs" : " differ");
    }

    /// The first differences before the others.
    std::string articles() const {
        std::string first, others;
        for (const Place& place : places_)
            if (place.image->verdict > Verdict::not_compared) (place.is_first ? first : others) += article(place);
        return first + others;
    }

    std::string name_of(const Place& place) const {
        return fmt::format("{}{}: {}", comparison_.frames.size() > 1 ? fmt::format("frame {}  ", place.frame->frame) : "",
                           place.pass->label, place.image->image);
    }

    std::string article(const Place& place) const {
        const std::string name = escaped(name_of(place)), reason = escaped(place.image->reason);
        const std::string choices =
            place.pass->choice_a == place.pass->choice_b
                ? ""
                : fmt::format("<p>A: {}<br>B: {}</p>", escaped(place.pass->choice_a), escaped(place.pass->choice_b));
        const std::string_view verdict = strata::name(place.image->verdict);
        const std::string head =
            fmt::format("<h3><span class=\"{0}\">{0}</span> {1}</h3><p>{2}</p>{3}\n", verdict, name, reason, choices);
        const auto* shown = shown_of(place);
        if (!shown) return fmt::format("<article>{}</article>\n", head);
        if (!fitting_.contains(&place))
            return fmt::format("<article>{}<p>no picture: the page would be too large; -o FOLDER writes them all</p></article>\n",
                               head);
        const PagePictures::Panel& a = shown->panels.front();
        const std::uint32_t width = (shown->width + shown->shrunk - 1) / shown->shrunk,
                            height = (shown->height + shown->shrunk - 1) / shown->shrunk;
        std::string text = fmt::format(
            "<article data-name=\"{}\" data-size=\"{} {}\" style=\"--a:url({});{}--shape:{} / {}\">{}<div class=\"panels "
            "whole\">",
            name, width, height, png_uri(a.whole), a.detail.empty() ? "" : fmt::format("--d:url({});", png_uri(a.detail)), width,
            height, head);
        for (const PagePictures::Panel& panel : shown->panels) text += figure(panel, panel.whole, *shown);
        text += "</div>";
        if (!a.detail.empty()) {
            text += "<div class=\"panels detail\">";
            for (const PagePictures::Panel& panel : shown->panels)
                text += fmt::format(
                    "<figure><div class=\"pic\">{}</div><figcaption><b>{}</b>, around the worst pixel</figcaption>"
                    "</figure>\n",
                    image(panel, panel.detail), escaped(panel.title));
            text += "</div>";
        }
        return text + "</article>\n";
    }

    static std::string image(const PagePictures::Panel& panel, const std::vector<std::byte>& png) {
        return panel.key == "a" ? "" : fmt::format("<img alt=\"\" src=\"{}\">", png_uri(png));
    }

    static std::string figure(const PagePictures::Panel& panel, const std::vector<std::byte>& png,
                              const PagePictures::Shown& shown) {
        const std::string size =
            shown.shrunk == 1 ? "" : fmt::format("; {} x {}, shown at 1/{}", shown.width, shown.height, shown.shrunk);
        return fmt::format(
            "<figure><button class=\"pic\" data-key=\"{}\" data-scale=\"{}\" aria-label=\"{}, enlarge\">{}</button>"
            "<figcaption><b>{}</b> {}{}</figcaption></figure>\n",
            panel.key, escaped(panel.scale), escaped(panel.title), image(panel, png), escaped(panel.title), escaped(panel.scale),
            panel.key == "a" ? size : "");
    }

    std::string table() const {
        const Sheet sheet = sheet_of(comparison_);
        const std::vector<std::size_t> shown = shown_columns(sheet, in_text);
        std::string text = "<table class=\"rows\"><thead><tr><th>frame</th>";
        for (const std::size_t column : shown)
            text += fmt::format("<th title=\"{}\">{}</th>", escaped(sheet.columns[column].help),
                                escaped(sheet.columns[column].title));
        text += "<th>reason</th></tr></thead>\n<tbody>\n";
        for (std::size_t i = 0; i < sheet.rows.size(); ++i) {
            const Place& place = places_[i];
            const std::string_view verdict = strata::name(place.image->verdict);
            text += fmt::format("<tr class=\"{0}\" data-verdict=\"{0}\"><td>{1}</td>", verdict, place.frame->frame);
            const bool has_figures = place.image->error.pixels > 0 && !place.image->error.identical;
            for (const std::size_t column : shown) {
                const CellValue& value = sheet.rows[i].values[column];
                const bool is_figure = sheet.columns[column].kind != CellKind::text || column == shown.back();
                text +=
                    fmt::format("<td>{}</td>", is_figure && !has_figures ? "" : escaped(cell_text(sheet.columns[column], value)));
            }
            text += fmt::format("<td>{}</td></tr>\n", escaped(place.image->reason));
        }
        return text + "</tbody></table>\n";
    }

    const Comparison& comparison_;
    const PagePictures& pictures_;
    std::vector<Place> places_;
    std::set<const Place*> fitting_;  ///< those whose pictures are in the page
};

}  // namespace

void PagePictures::add(std::size_t frame, const PassComparison& pass, const ImageComparison& made, const HostImage& a,
                       const HostImage& b) {
    std::size_t kept = 0;
    for (const Shown& shown : all_) kept += shown.bytes;
    if (made.verdict <= Verdict::not_compared || kept > most_kept) return;
    const std::vector<PlainPanel> panels = plain_panels(made, a, b);
    const Canvas& of_a = panels.front().canvas;
    Shown shown{
        .case_name = case_name(frame, pass, made), .width = std::uint32_t(of_a.width()), .height = std::uint32_t(of_a.height())};
    const std::uint32_t edge = std::max(shown.width, shown.height);
    shown.shrunk = (edge + page_picture_edge - 1) / page_picture_edge;
    const Box box = detail_box(made.error.worst_pixel, of_a);
    const Pixels whole_a = shrunk(of_a, int(shown.shrunk), false), detail_a = cut(of_a, box);
    for (const PlainPanel& panel : panels) {
        const bool is_picture = panel.key == "a" || panel.key == "b";
        const Pixels whole = shrunk(panel.canvas, int(shown.shrunk), !is_picture);
        Panel encoded{panel.key, panel.title, panel.scale, panel.key == "b" ? png_over(whole, whole_a) : png_of(whole), {}};
        if (edge > 4 * page_detail_edge) {
            const Pixels detail = cut(panel.canvas, box);
            encoded.detail = panel.key == "b" ? png_over(detail, detail_a) : png_of(detail);
        }
        shown.bytes += encoded.whole.size() + encoded.detail.size();
        shown.panels.push_back(std::move(encoded));
    }
    all_.push_back(std::move(shown));
}

const PagePictures::Shown* PagePictures::find(const std::string& case_name) const {
    const auto found = std::ranges::find(all_, case_name, &Shown::case_name);
    return found == all_.end() ? nullptr : &*found;
}

std::string as_html(const Comparison& comparison, const PagePictures& pictures) {
    return DifferencePage(comparison, pictures).text();
}

}  // namespace strata
