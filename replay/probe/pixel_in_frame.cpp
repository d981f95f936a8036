// The pixel as each technique leaves it in the frame itself, beside the exact one.
#include <algorithm>
#include <iterator>
#include <optional>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/reference/display_light.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/probe/probe.h"
#include "replay/session/choice_text.h"
#include "replay/session/stand_in.h"

namespace strata {
namespace {

/// The pixel with all its samples, as an image of its own; nothing where the device lacks what the technique needs.
Result<std::optional<ReferenceImage>> pixel_of(Session& session, const Request& request, PixelAt at) {
    const auto images = session.stage_images(request, Stage::transparency);
    if (!images && images.error().fault == Fault::device_lacks) return std::optional<ReferenceImage>();
    if (!images) return images.error();
    const ReferenceImage& color = images->at("color");
    ReferenceImage pixel(1, 1, color.layers);
    for (std::uint32_t layer = 0; layer < color.layers; ++layer) pixel.at(0, 0, layer) = color.at(at.x, at.y, layer);
    return std::optional(std::move(pixel));
}

bool lacks_display_error(const ProbeCurve& curve) { return !curve.metrics.display_error && curve.not_supported.empty(); }

}  // namespace

Result<void> add_display_errors(Session& session, const Request& request, Probe& probe) {
    if (std::ranges::none_of(probe.curves, lacks_display_error)) return {};
    const auto frame = session.frame(request.variant.frame);
    if (!frame) return frame.error();
    const auto planned = session.plan(request);
    if (!planned) return planned.error();
    const auto exact_request = stand_in(session, Stage::transparency, request);
    if (!exact_request) return exact_request.error();
    if (!*exact_request) return {};
    const auto exact = pixel_of(session, **exact_request, probe.at);
    if (!exact) return exact.error();
    if (!*exact) return {};
    const auto shown = [&](const ReferenceImage& pixel) {
        return tone_mapped(pixel, double(frame->view.exposure), double(frame->film.white));
    };
    for (ProbeCurve& curve : probe.curves) {
        if (!lacks_display_error(curve)) continue;
        auto parsed = parse_variant(Stage::transparency, curve.variant);
        if (!parsed) return parsed.error();
        if (unsupported(*parsed->technique, planned->features)) continue;
        Request variant = request;
        variant.choices.drop(Stage::transparency);
        variant.choices.use(*parsed->technique);
        std::ranges::move(parsed->settings, std::back_inserter(variant.choices.settings));
        const auto got = pixel_of(session, variant, probe.at);
        if (!got) return got.error();
        if (*got) curve.metrics.display_error = display_error(shown(**got), shown(**exact)).rmse;
    }
    return {};
}

}  // namespace strata
