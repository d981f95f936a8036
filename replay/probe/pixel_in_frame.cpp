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

namespace strata {
namespace {

Request with(Request request, const Technique& technique) {
    request.choices.drop(Stage::transparency);
    request.choices.use(technique);
    return request;
}

/// The texel as an image of its own; nothing where the device lacks what the technique needs.
Result<std::optional<ReferenceImage>> texel_of(Session& session, const Request& request, PixelAt at) {
    const auto images = session.stage_images(request, Stage::transparency);
    if (!images && images.error().fault == Fault::device_lacks) return std::optional<ReferenceImage>();
    if (!images) return images.error();
    return std::optional(ReferenceImage(1, 1, 1, images->at("color").at(at.x, at.y, at.sample)));
}

/// By the first technique that is exact and can do the frame.
Result<std::optional<ReferenceImage>> exact_texel(Session& session, const Request& request, const Features& features,
                                                  PixelAt at) {
    for (const Technique* technique : techniques_of(Stage::transparency))
        if (technique->abilities.stands_in_for_truth && !unsupported(*technique, features))
            return texel_of(session, with(request, *technique), at);
    return std::optional<ReferenceImage>();
}

}  // namespace

Result<void> add_display_errors(Session& session, const Request& request, Probe& probe) {
    const auto frame = session.frame(request.variant.frame);
    if (!frame) return frame.error();
    const auto planned = session.plan(request);
    if (!planned) return planned.error();
    const auto exact = exact_texel(session, request, planned->features, probe.at);
    if (!exact) return exact.error();
    if (!*exact) return {};
    const auto shown = [&](const ReferenceImage& texel) {
        return tone_mapped(texel, double(frame->view.exposure), double(frame->film.white));
    };
    for (ProbeCurve& curve : probe.curves) {
        if (curve.metrics.display_error || !curve.not_supported.empty()) continue;
        auto parsed = parse_variant(Stage::transparency, curve.variant);
        if (!parsed) return parsed.error();
        if (unsupported(*parsed->technique, planned->features)) continue;
        Request variant = with(request, *parsed->technique);
        std::ranges::move(parsed->settings, std::back_inserter(variant.choices.settings));
        const auto got = texel_of(session, variant, probe.at);
        if (!got) return got.error();
        if (*got) curve.metrics.display_error = display_error(shown(**got), shown(**exact)).rmse;
    }
    return {};
}

}  // namespace strata
