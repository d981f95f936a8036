#include "replay/report/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "capture_format/export/png.h"
#include "capture_format/frame/frame.h"
#include "passes/reference/display_light.h"
#include "passes/reference/textures.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/difference/canvas.h"
#include "replay/images/image_io.h"
#include "replay/measure/flip.h"
#include "replay/probe/probe.h"
#include "replay/report/variants.h"
#include "replay/session/light_unit.h"

namespace strata {
namespace {

// Up to so many rows each has the plot of its worst pixel; of more those that one looks at.
constexpr std::size_t few_rows = 20;

/// A picture as sRGB encodes it, 0 to 1; each pixel is the mean of its samples. What is not finite shows as black.
struct ShownPicture {
    std::uint32_t width = 0, height = 0;
    std::vector<glm::dvec3> pixels;
    std::vector<std::array<std::byte, 3>> bytes;
    ColorPlanes light;
    std::vector<bool> undecided;  ///< by pixel: rounding decides a sample of it
};

ShownPicture shown_picture(const ReferenceImage& display) {
    ShownPicture picture{.width = display.width, .height = display.height, .light = color_planes(display)};
    const std::size_t pixels = std::size_t(display.width) * display.height;
    picture.pixels.resize(pixels, glm::dvec3(0));
    picture.undecided.resize(pixels);
    for (std::size_t i = 0; i < display.undecided.size(); ++i)
        if (display.undecided[i]) picture.undecided[i % pixels] = true;
    for (std::size_t i = 0; i < display.texels.size(); ++i) picture.pixels[i % pixels] += glm::dvec3(display.texels[i]);
    for (glm::dvec3& pixel : picture.pixels) {
        pixel /= double(display.layers);
        picture.bytes.push_back({display_byte(pixel.x), display_byte(pixel.y), display_byte(pixel.z)});
        for (int c = 0; c < 3; ++c) pixel[c] = std::isfinite(pixel[c]) ? linear_to_srgb(std::clamp(pixel[c], 0., 1.)) : 0;
    }
    return picture;
}

std::vector<std::byte> png_of(const ShownPicture& picture) {
    return encode_png(picture.width, picture.height, 3, std::as_bytes(std::span(picture.bytes)));
}

RowPicture row_picture(const ShownPicture& row, const ShownPicture& truth) {
    RowPicture made;
    double worst = 0;
    std::vector<std::byte> rgba(4 * row.pixels.size());
    for (std::size_t i = 0; i < row.pixels.size(); ++i) {
        if (row.bytes[i] != truth.bytes[i]) {
            std::ranges::copy(row.bytes[i], rgba.begin() + std::ptrdiff_t(4 * i));
            rgba[4 * i + 3] = std::byte{255};
        }
        const double off = glm::distance(row.pixels[i], truth.pixels[i]);
        if (off <= worst || truth.undecided[i]) continue;
        worst = made.worst_off = off;
        made.worst_x = std::uint32_t(i % row.width), made.worst_y = std::uint32_t(i / row.width);
    }
    made.png = encode_png(row.width, row.height, 4, rgba);
    return made;
}

std::vector<std::byte> flip_png(const ShownPicture& row, const ShownPicture& truth) {
    std::vector<Rgb> map;
    for (const float flip : display_flip(truth.light, row.light).map) map.push_back(magma(double(flip)));
    return encode_png(row.width, row.height, 3, std::as_bytes(std::span(map)));
}

/// For each row whether a page begins with it or sets it off: those of the front and of the answer, the baseline, the most
/// accurate. Maps of FLIP take a second each where pictures are large.
std::vector<bool> rows_looked_at(const Report& report) {
    std::vector<bool> looked_at(report.rows.size());
    const Answer answer = answer_of(report);
    for (const auto row : {answer.recommended, answer.nearest, baseline_of(report)})
        if (row) looked_at[*row] = true;
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < report.rows.size(); ++i) {
        const Measurement& row = report.rows[i];
        if (row.on_front) looked_at[i] = true;
        if (!row.is_measured() || row.has_other_truth) continue;
        if (!best || ranking_metric(row).value < ranking_metric(report.rows[*best]).value) best = i;
    }
    if (best) looked_at[*best] = true;
    return looked_at;
}

/// The SVG of T(z) at the row's worst pixel; empty for other stages, for rows that show as the truth does, and where no fragment
/// lies.
Result<std::string> worst_pixel(Session& session, const ReportRequest& wanted, const Variant& row, const RowPicture& picture) {
    if (wanted.stage != Stage::transparency || picture.worst_off == 0) return std::string();
    const auto made = probe(session, wanted.base, {.x = picture.worst_x, .y = picture.worst_y},
                            {.variants = {label(row.technique->name, row.settings)}, .samples = 256});
    if (made) return as_svg(*made);
    return made.error().id == "probe.no_fragment" ? Result<std::string>(std::string()) : Result<std::string>(made.error());
}

/// Makes pictures of one stage of one frame.
class Pictures {
public:
    Pictures(Session& session, const Report& report, const Frame& frame)
        : session_(&session), frame_(&frame), stage_(report.stage) {
        const std::string_view first = info(report.stage).outputs.front();
        if (holds_radiance(first) && report.error_at == ErrorAt::stage) radiance_ = first;
    }

    Result<ShownPicture> of(const Request& request) const {
        if (!radiance_.empty())
            return session_->stage_images(request, stage_).and_then([&](auto& images) {
                return Result<ShownPicture>(shown(images.at(radiance_)));
            });
        return picture_of(session_->run(as_picture(request)));
    }

    Result<ShownPicture> of_truth(const Request& base, const RowTruth& truth) const {
        if (truth.picture) return shown_picture(truth.picture->display);
        if (!radiance_.empty()) return shown(truth.truth.find(radiance_)->second);
        if (makes_picture(stage_)) return shown_picture(truth.truth.find(picture_image)->second);
        return picture_of(session_->run_from(as_picture(base), stage_, truth.truth));
    }

private:
    static Request as_picture(Request request) {
        request.outputs = {picture_image};
        return request;
    }
    static Result<ShownPicture> picture_of(const Result<Run>& run) {
        if (!run) return run.error();
        return shown_picture(in_double(run->images.at(picture_image)));
    }
    ShownPicture shown(const ReferenceImage& radiance) const {
        return shown_picture(tone_mapped(radiance, double(frame_->view.exposure), double(frame_->film.white)));
    }

    Session* session_;
    const Frame* frame_;
    Stage stage_;
    std::string radiance_;  ///< the stage's image; empty: the frame's picture is shown
};

}  // namespace

Result<void> add_pictures(Session& session, const ReportRequest& wanted, std::span<const Variant> all, const RowTruths& truths,
                          Report& report) {
    const auto frame = session.frame(wanted.base.variant.frame);
    if (!frame) return frame.error();
    const Pictures pictures(session, report, *frame);
    const auto truth = pictures.of_truth(wanted.base, truths.all.front());
    // Later stages read more of the pass than images, which no truth has: culling, shadow maps that lighting reads itself.
    if (!truth && truth.error().fault == Fault::usage) return {};
    if (!truth) return truth.error();
    report.truth_picture = png_of(*truth);
    const std::vector<bool> looked_at = rows_looked_at(report);
    for (std::size_t i = 0; i < report.rows.size(); ++i) {
        if (!report.rows[i].is_measured() || truths.of_row[i] != 0) continue;
        const auto row = pictures.of(all[i].request);
        if (!row) return row.error();
        report.rows[i].picture = row_picture(*row, *truth);
        if (looked_at[i]) report.rows[i].picture->flip_png = flip_png(*row, *truth);
        if (!looked_at[i] && report.rows.size() > few_rows) continue;
        auto svg = worst_pixel(session, wanted, all[i], *report.rows[i].picture);
        if (!svg) return svg.error();
        report.rows[i].picture->probe_svg = *std::move(svg);
    }
    return {};
}

}  // namespace strata
