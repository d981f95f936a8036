#include "replay/report/picture_error.h"

#include <algorithm>
#include <utility>

#include "passes/frame_images.h"
#include "passes/reference/difference.h"
#include "passes/reference/display_light.h"
#include "passes/reference/settle.h"
#include "passes/stage_input.h"
#include "passes/stages.h"
#include "replay/measure/flip.h"
#include "replay/session/judgment.h"
#include "replay/session/light_unit.h"

namespace strata {
namespace {

Result<ReferenceImage> picture_from(Session& session, Request request, Stage stage, const ImageSet& outputs) {
    request.outputs = {picture_image};
    return session.run_from(request, stage, outputs).and_then([](auto& run) { return in_double(run.images.at(picture_image)); });
}

/// Images of the shapes of the truth, all of one value.
ImageSet plain_outputs(const ImageSet& truth, double value) {
    ImageSet plain;
    for (const auto& [name, image] : truth) {
        ReferenceImage made(image.width, image.height, image.layers, glm::dvec4(value));
        made.channels = image.channels;
        plain.emplace(name, std::move(made));
    }
    return plain;
}

/// The stage's outputs as its technique finds them; black where no stage before it writes them.
Result<ImageSet> found_before(Session& session, const Request& request, Stage stage, const ImageSet& truth) {
    const auto passes = session.pass_images(request);
    if (!passes) return passes.error();
    ImageSet before = plain_outputs(truth, 0);
    for (const PassImages& pass : *passes) {
        if (pass.at == stage) break;
        for (const auto& [name, image] : pass.images)
            if (const auto wanted = before.find(name); wanted != before.end()) wanted->second = in_double(image);
    }
    return before;
}

/// A picture that differs from the truth's where the stage's choice can change something. A stage that makes light gets nothing
/// wrong where it adds none. Surfaces and masks may be wrong wherever they are seen: where black is right, a mask may be white.
Result<ReferenceImage> picture_of_others(Session& session, const Request& request, Stage stage, const ImageSet& truth,
                                         const ReferenceImage& display) {
    if (holds_radiance(info(stage).outputs.front())) {
        const auto before = found_before(session, request, stage, truth);
        return before ? picture_from(session, request, stage, *before) : Result<ReferenceImage>(before.error());
    }
    auto others = picture_from(session, request, stage, plain_outputs(truth, 0));
    const bool are_masks = std::ranges::all_of(truth, [](const auto& output) { return output.second.channels == 1; });
    if (!others || !are_masks) return others;
    const auto white = picture_from(session, request, stage, plain_outputs(truth, 1));
    if (!white) return white.error();
    for (std::size_t i = 0; i < display.texels.size(); ++i)
        if (others->texels[i] == display.texels[i]) others->texels[i] = white->texels[i];
    return others;
}

/// Leaves out the pixels of which a sample of the stage's picture is undecided, and what else it may be is not known. Images of
/// another extent say nothing of pixels.
void leave_out_undecided(const ReferenceImage& truth, ReferenceImage& display) {
    const std::size_t pixels = std::size_t(display.width) * display.height;
    if (truth.width != display.width || truth.height != display.height) return;
    display.undecided.resize(pixels);
    const std::vector<bool> is_known = has_alternatives(truth);
    for (std::size_t i = 0; i < truth.undecided.size(); ++i)
        if (truth.undecided[i] && !is_known[i]) display.undecided[i % pixels] = true;
}

constexpr std::size_t most_other_pictures = 3;

/// The truth with the same alternative, or the last, in all undecided texels; nothing where no texel has so many.
std::optional<ImageSet> other_truth(const ImageSet& truth, std::size_t number) {
    std::optional<ImageSet> made;
    for (const auto& [name, image] : truth) {
        std::size_t of_texel = 0;
        for (std::size_t i = 0; i < image.alternatives.size(); ++i) {
            const auto& [texel, value] = image.alternatives[i];
            of_texel = i > 0 && image.alternatives[i - 1].texel == texel ? of_texel + 1 : 0;
            if (of_texel > number) continue;
            if (of_texel == number && !made) made = truth;
            if (made) made->at(name).texels[texel] = value;
        }
    }
    return made;
}

/// Pixels that show something else where the truth may be something else are undecided, with that as an alternative.
Result<void> add_alternatives(Session& session, const Request& request, Stage stage, const ImageSet& truth,
                              ReferenceImage& display) {
    display.undecided.resize(display.texels.size());
    for (std::size_t number = 0; number < most_other_pictures; ++number) {
        const auto outputs = other_truth(truth, number);
        if (!outputs) break;
        const auto other = picture_from(session, request, stage, *outputs);
        if (!other) return other.error();
        for (std::size_t i = 0; i < display.texels.size(); ++i) {
            if (other->texels[i] == display.texels[i]) continue;
            display.undecided[i] = true;
            display.alternatives.push_back({i, other->texels[i]});
        }
    }
    std::ranges::stable_sort(display.alternatives, {}, &Alternative::texel);
    return {};
}

/// Smaller is better; shares in percent of the pixels that are compared.
std::vector<Metric> metrics_of(const DisplayError& error, const ReferenceImage& got, const ReferenceImage& wanted) {
    return {{display_rmse, "of white", error.rmse},
            {"relative rmse", "", difference(got, wanted).relative, true},
            {"worst", "of white", error.worst, true},
            {"off by 1/255", "%", 100 * error.over_1_255, true},
            {"over 5/255", "%", 100 * error.over_5_255}};
}

}  // namespace

bool makes_picture(Stage stage) { return std::ranges::count(info(stage).outputs, picture_image) > 0; }

bool makes_light(Stage stage) {
    const auto& outputs = info(stage).outputs;
    return makes_picture(stage) || (!outputs.empty() && holds_radiance(outputs.front()));
}

Result<PictureTruth> picture_truth(Session& session, const Request& request, Stage stage, const ImageSet& truth) {
    if (makes_picture(stage))
        return fail(Fault::usage, "report.stage_makes_picture",
                    "the stage {stage} makes the picture itself: its errors are those of the picture", name(stage));
    auto display = picture_from(session, request, stage, truth);
    if (!display) return display.error();
    const auto others = picture_of_others(session, request, stage, truth, *display);
    if (!others) return others.error();
    if (const auto added = add_alternatives(session, request, stage, truth, *display); !added) return added.error();
    if (const auto shown = truth.find(info(stage).outputs.front()); shown != truth.end())
        leave_out_undecided(shown->second, *display);
    PictureTruth made{.display = *display, .touched = *std::move(display)};
    made.touched_share = keep_touched(made.touched, &*others).value_or(0);
    return made;
}

Result<void> judge_picture(Session& session, Request request, const PictureTruth& truth, Accuracy& accuracy) {
    request.outputs = {picture_image};
    const auto run = session.run(request);
    if (!run) return run.error();
    const HostImage& display = run->images.at(picture_image);
    const ReferenceImage got = in_double(display);
    ReferenceImage wanted = truth.display, touched = truth.touched;
    accuracy.undecided_share = undecided_share(wanted);
    ReferenceImage encoded = srgb_encoded(wanted);
    accuracy.undecided_bound = Metric{display_rmse, "of white", settle(srgb_encoded(got), encoded)};
    settle(got, wanted);
    accuracy.unjudged_share = undecided_share(wanted);
    settle(got, touched);
    if (accuracy.unjudged_share == 1) {
        accuracy.not_supported = "no pixel can be judged: rounding decides what a sample of each of them shows";
        accuracy.technique_errors.clear();
        accuracy.flip.reset();
        return {};
    }
    accuracy.not_numbers = leave_out_not_numbers(got, wanted);
    leave_out_not_numbers(got, touched);
    if (accuracy.not_numbers > 0 && undecided_share(wanted) == 1) {
        accuracy.not_supported = nothing_but_not_numbers(accuracy.not_numbers, "pixel");
        accuracy.technique_errors.clear();
        accuracy.flip.reset();
        return {};
    }
    accuracy.stage_errors = std::exchange(accuracy.technique_errors, metrics_of(display_error(got, wanted), got, wanted));
    accuracy.flip = display_flip(color_planes(wanted), color_planes(got)).mean;
    accuracy.touched.clear(), accuracy.footing.emplace(), accuracy.touched_share = 1;
    if (truth.touched_share == 0) return {};
    const DisplayError error = display_error(got, touched);
    accuracy.touched = metrics_of(error, got, touched);
    accuracy.footing = footing_of(error);
    accuracy.touched_share = truth.touched_share;
    return {};
}

}  // namespace strata
