#include "replay/report/pictures.h"

#include <algorithm>
#include <cmath>

#include "capture_format/export/png.h"
#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/reference/display_light.h"
#include "passes/reference/textures.h"
#include "passes/stages.h"
#include "replay/images/image_io.h"

namespace strata {
namespace {

constexpr const char* frame_picture = "display";

/// Linear display light, one color per pixel.
struct DisplayPicture {
    std::uint32_t width = 0, height = 0;
    std::vector<glm::dvec3> pixels;
};

DisplayPicture mean_of_samples(const ReferenceImage& image) {
    DisplayPicture picture{.width = image.width, .height = image.height};
    const std::size_t pixels = std::size_t(image.width) * image.height;
    picture.pixels.resize(pixels, glm::dvec3(0));
    for (std::size_t i = 0; i < image.texels.size(); ++i) picture.pixels[i % pixels] += glm::dvec3(image.texels[i]);
    for (glm::dvec3& pixel : picture.pixels) pixel /= double(image.layers);
    return picture;
}

std::array<std::byte, 3> bytes_of(const glm::dvec3& pixel) {
    return {display_byte(pixel.x), display_byte(pixel.y), display_byte(pixel.z)};
}

/// Of white; what is not finite shows as black, as in every picture.
double distance_shown(const glm::dvec3& a, const glm::dvec3& b) {
    double squares = 0;
    for (int c = 0; c < 3; ++c) {
        const auto shown = [](double light) { return std::isfinite(light) ? linear_to_srgb(std::clamp(light, 0., 1.)) : 0; };
        squares += (shown(a[c]) - shown(b[c])) * (shown(a[c]) - shown(b[c]));
    }
    return std::sqrt(squares / 3);
}

std::vector<std::byte> png_of(const DisplayPicture& picture) {
    std::vector<std::byte> rgb;
    for (const glm::dvec3& pixel : picture.pixels) std::ranges::copy(bytes_of(pixel), std::back_inserter(rgb));
    return encode_png(picture.width, picture.height, 3, rgb);
}

RowPicture row_picture(const DisplayPicture& row, const DisplayPicture& truth) {
    RowPicture made;
    std::vector<std::byte> rgba;
    for (std::size_t i = 0; i < row.pixels.size(); ++i) {
        const auto bytes = bytes_of(row.pixels[i]);
        const bool shows_the_same = bytes == bytes_of(truth.pixels[i]);
        for (const std::byte byte : bytes) rgba.push_back(shows_the_same ? std::byte{0} : byte);
        rgba.push_back(shows_the_same ? std::byte{0} : std::byte{255});
        const double off = distance_shown(row.pixels[i], truth.pixels[i]);
        if (off <= made.worst) continue;
        made.worst = off;
        made.worst_x = std::uint32_t(i % row.width), made.worst_y = std::uint32_t(i / row.width);
    }
    made.png = encode_png(row.width, row.height, 4, rgba);
    return made;
}

/// Makes pictures of one stage of one frame.
class Pictures {
public:
    Pictures(Session& session, const ReportRequest& wanted, const Frame& frame) : session_(&session), frame_(&frame) {
        const std::string_view first = info(wanted.stage).outputs.front();
        const FrameImageRow* row = find_frame_image(first);
        const bool is_radiance = row && row->content == Content::radiance;
        if (is_radiance && wanted.error_at == ErrorAt::stage) radiance_ = first;
    }

    std::string image() const { return radiance_.empty() ? frame_picture : radiance_; }

    Result<DisplayPicture> of(Request request) const {
        request.outputs = {image()};
        return session_->run(request).and_then([&](auto& run) { return shown(in_double(run.images.at(image()))); });
    }

    Result<DisplayPicture> of_truth(const Request& base, Stage stage, const RowTruth& truth) const {
        if (truth.picture) return mean_of_samples(truth.picture->display);
        if (!radiance_.empty()) return shown(truth.truth.find(radiance_)->second);
        Request request = base;
        request.outputs = {frame_picture};
        if (std::ranges::count(info(stage).outputs, frame_picture) > 0)
            return mean_of_samples(truth.truth.find(frame_picture)->second);
        return session_->run_from(request, stage, truth.truth).and_then([](auto& run) {
            return Result<DisplayPicture>(mean_of_samples(in_double(run.images.at(frame_picture))));
        });
    }

private:
    Result<DisplayPicture> shown(const ReferenceImage& image) const {
        if (radiance_.empty()) return mean_of_samples(image);
        return mean_of_samples(tone_mapped(image, double(frame_->view.exposure), double(frame_->film.white)));
    }

    Session* session_;
    const Frame* frame_;
    std::string radiance_;  ///< the stage's image; empty: the frame's picture is shown
};

}  // namespace

Result<void> add_pictures(Session& session, const ReportRequest& wanted, std::span<const Variant> all, const RowTruths& truths,
                          Report& report) {
    const auto frame = session.frame(wanted.base.variant.frame);
    if (!frame) return frame.error();
    const Pictures pictures(session, wanted, *frame);
    const auto truth = pictures.of_truth(wanted.base, wanted.stage, truths.all.front());
    if (!truth) return truth.error();
    report.truth_picture = png_of(*truth);
    for (std::size_t i = 0; i < report.rows.size(); ++i) {
        if (report.rows[i].accuracy.technique_errors.empty() || truths.of_row[i] != 0) continue;
        const auto row = pictures.of(all[i].request);
        if (!row) return row.error();
        report.rows[i].picture = row_picture(*row, *truth);
    }
    return {};
}

}  // namespace strata
