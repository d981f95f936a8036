#include "replay/report/compare_with_truth.h"

#include <algorithm>
#include <span>
#include <utility>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/reference/settle.h"
#include "passes/stages.h"
#include "replay/plural.h"
#include "replay/report/row_truth.h"
#include "replay/session/describe_run.h"
#include "replay/session/judgment.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

HostImage in_floats(const ReferenceImage& image, Content content) {
    const std::uint32_t channels = image.channels == 1 ? 1 : image.channels == 2 ? 2 : 4;
    const Format format = content == Content::depth ? Format::d32f
                          : channels == 1           ? Format::r32f
                          : channels == 2           ? Format::rg32f
                                                    : Format::rgba32f;
    std::vector<float> values;
    values.reserve(image.texels.size() * channels);
    for (const glm::dvec4& texel : image.texels)
        for (std::uint32_t c = 0; c < channels; ++c) values.push_back(static_cast<float>(texel[static_cast<glm::length_t>(c)]));
    const auto bytes = std::as_bytes(std::span(values));
    return {{.extent = {image.width, image.height, 1}, .format = format, .layers = image.layers}, {bytes.begin(), bytes.end()}};
}

/// A result and what it should be.
struct Beside {
    HostImage wanted, got;
    std::size_t undecided = 0;  ///< texels that are made equal
};

Beside beside(const ReferenceImage& got, ReferenceImage truth, Content content) {
    settle(got, truth);
    truth.channels = got.channels;
    Beside made;
    for (std::size_t i = 0; i < truth.texels.size(); ++i) {
        const bool is_undecided = !truth.undecided.empty() && truth.undecided[i];
        made.undecided += is_undecided;
        if (is_undecided) truth.texels[i] = got.texels[i];
        // Errors of light are those of its colors.
        if (content == Content::radiance || content == Content::display) truth.texels[i].w = got.texels[i].w;
    }
    made.wanted = in_floats(truth, content);
    made.got = in_floats(got, content);
    return made;
}

Result<FrameComparison> compare_each(PassComparison pass, const ImageSet& truth, const ImageSet& got, const ErrorLimits& limits,
                                     const SeeImages& see) {
    FrameComparison frame;
    std::size_t undecided = 0;
    for (const auto& [name, wanted] : truth) {
        if (!limits.asks_for(name)) continue;
        const auto result = got.find(name);
        const Content content = find_frame_image(name)->content;
        const bool is_coded = content == Content::coded;  // in a layout of the technique's own
        if (is_coded || result == got.end() || !same_extent(wanted, result->second)) {
            pass.images.push_back({.image = name,
                                   .verdict = is_coded ? Verdict::not_compared : Verdict::over,
                                   .reason = is_coded              ? "its layout is the technique's own"
                                             : result == got.end() ? "only the truth has it"
                                                                   : "the truth has another extent"});
            continue;
        }
        const Beside both = beside(result->second, wanted, content);
        auto made = compare_images(name, both.wanted, both.got, limits);
        if (!made) return made.error();
        undecided += both.undecided;
        if (see)
            if (const auto seen = see(pass, *made, both.wanted, both.got); !seen) return seen.error();
        pass.images.push_back(*std::move(made));
    }
    if (undecided > 0)
        frame.notes.push_back(fmt::format("{} count as equal: rounding decides the truth there", plural(undecided, "texel")));
    add_pass(frame, std::move(pass));
    return frame;
}

/// Images of the stage, or the picture.
Result<ImageSet> images_of(const RunToCompare& run, Stage stage, ErrorAt at) {
    if (at == ErrorAt::stage) return run.session.stage_images(run.request, stage);
    Request request = run.request;
    request.outputs = {picture_image};
    return run.session.run(request).and_then([](const Run& made) {
        return Result<ImageSet>(ImageSet{{picture_image, in_double(made.images.at(picture_image))}});
    });
}

/// The row's errors as a report has them, in a sentence.
Result<std::string> error_text(const RunToCompare& run, Stage stage, const RowTruth& truth) {
    auto accuracy = run.session.judge(run.request, stage, Against::truth, &truth.truth);
    if (!accuracy) return accuracy.error();
    if (truth.picture)
        if (const auto judged = judge_picture(run.session, run.request, *truth.picture, *accuracy); !judged)
            return judged.error();
    const bool is_touched = !accuracy->touched.empty();
    const std::vector<Metric>& errors = is_touched ? accuracy->touched : accuracy->technique_errors;
    if (errors.empty()) return accuracy->not_supported;
    const auto of_display = std::ranges::find(errors, display_rmse, &Metric::name);
    const Metric& shown = of_display == errors.end() ? errors.front() : *of_display;
    const std::string value =
        is_of_white(shown) ? fmt::format("{} % of white", short_number(100 * shown.value)) : short_number(shown.value);
    return fmt::format("as a report has it: {} {}{}", shown.name, value,
                       is_touched ? fmt::format(" over the {:.3g} % of the pixels that {} can change",
                                                100 * accuracy->touched_share, name(stage))
                                  : "");
}

}  // namespace

Result<TruthComparison> compare_with_truth(const RunToCompare& run, Stage stage, ErrorAt at, const ErrorLimits& limits,
                                           const SeeImages& see) {
    if (const auto has_some = check_has_techniques(stage); !has_some) return has_some.error();
    if (at == ErrorAt::stage && !makes_light(stage))
        return fail(Fault::usage, "diff.stage_makes_no_light",
                    "{stage} makes no light, so its errors are measured in the picture; pass --error-at picture", name(stage));
    const auto frame = run.session.frame(run.request.variant.frame);
    if (!frame) return frame.error();
    const Variant row{.request = run.request};
    const auto truths = find_row_truths(run.session, {.base = run.request, .error_at = at, .stage = stage}, {&row, 1}, *frame);
    if (!truths) return truths.error();
    const RowTruth& truth = truths->all.front();
    const auto choices = choose(*frame, run.request.choices);
    if (!choices) return choices.error();
    const auto images = images_of(run, stage, at);
    if (!images) return images.error();
    auto compared = compare_each(
        {.label = std::string(name(stage)), .choice_a = "the truth", .choice_b = choice_line(choices->at(stage))},
        at == ErrorAt::picture ? ImageSet{{picture_image, truth.picture->display}} : truth.truth, *images, limits, see);
    if (!compared) return compared.error();
    compared->frame = run.request.variant.frame;
    const auto error = error_text(run, stage, truth);
    if (!error) return error.error();
    compared->notes.insert(compared->notes.begin(), *error);
    return TruthComparison{*std::move(compared), fmt::format("truth of {}: {}", name(stage), truth.name)};
}

}  // namespace strata
