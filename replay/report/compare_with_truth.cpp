#include "replay/report/compare_with_truth.h"

#include <algorithm>
#include <span>
#include <utility>

#include "capture_format/frame/frame.h"
#include "passes/reference/settle.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/plural.h"
#include "replay/report/report_columns.h"
#include "replay/report/row_truth.h"
#include "replay/session/choices.h"
#include "replay/session/judgment.h"

namespace strata {
namespace {

constexpr const char* picture = "display";

/// Floats of a shape; depth stays depth.
HostImage host_image(const ReferenceImage& image, Shape shape) {
    const FormatRow& stored = row(shape.format);
    if (shape.format != Format::d32f)
        shape.format = stored.channels == 1 ? Format::r32f : stored.channels == 2 ? Format::rg32f : Format::rgba32f;
    std::vector<float> values;
    values.reserve(image.texels.size() * row(shape.format).channels);
    for (const glm::dvec4& texel : image.texels)
        for (std::uint32_t c = 0; c < row(shape.format).channels; ++c)
            values.push_back(static_cast<float>(texel[static_cast<glm::length_t>(c)]));
    const auto bytes = std::as_bytes(std::span(values));
    return {shape, {bytes.begin(), bytes.end()}};
}

/// A result and what it should be, in the same floats.
struct Beside {
    HostImage wanted, got;
    std::size_t undecided = 0;  ///< texels that are made equal
};

Beside beside(const HostImage& result, ReferenceImage truth, Content content) {
    const ReferenceImage got = in_double(result);
    settle(got, truth);
    Beside made;
    for (std::size_t i = 0; i < truth.texels.size(); ++i) {
        const bool is_undecided = !truth.undecided.empty() && truth.undecided[i];
        made.undecided += is_undecided;
        if (is_undecided) truth.texels[i] = got.texels[i];
        // Errors of light are those of its colors.
        if (content == Content::radiance || content == Content::display) truth.texels[i].w = got.texels[i].w;
    }
    made.wanted = host_image(truth, result.shape);
    made.got = host_image(got, result.shape);
    return made;
}

bool is_of_shape(const ReferenceImage& truth, const Shape& shape) {
    return truth.width == shape.extent.width && truth.height == shape.extent.height &&
           truth.layers == shape.layers * shape.extent.depth;
}

/// What is compared, of one pass.
struct Wanted {
    PassComparison pass;
    std::map<std::string, HostImage> images;
    const ImageSet& truth;
};

Result<FrameComparison> compare_images_of(Wanted wanted, const ErrorLimits& limits, const SeeImages& see) {
    FrameComparison frame;
    std::size_t undecided = 0;
    for (const auto& [name, result] : wanted.images) {
        const auto truth = wanted.truth.find(name);
        if (truth == wanted.truth.end() || !limits.asks_for(name)) continue;
        const Content content = content_of(name, result.shape.format);
        if (content == Content::coded || !is_of_shape(truth->second, result.shape)) {
            wanted.pass.images.push_back(
                {.image = name, .verdict = Verdict::not_compared, .reason = "its layout is the technique's own"});
            continue;
        }
        const Beside both = beside(result, truth->second, content);
        auto made = compare_images(name, both.wanted, both.got, limits);
        if (!made) return made.error();
        undecided += both.undecided;
        if (see)
            if (const auto seen = see(wanted.pass, *made, both.wanted, both.got); !seen) return seen.error();
        wanted.pass.images.push_back(*std::move(made));
    }
    if (undecided > 0)
        frame.notes.push_back(fmt::format("{} left out: rounding decides the truth there", plural(undecided, "texel")));
    add_pass(frame, std::move(wanted.pass));
    return frame;
}

/// What the stage's pass gives. Images that a technique makes for nobody but who asks for them are asked for.
Result<PassImages> pass_of(const RunToCompare& run, Stage stage, const ImageSet& truth) {
    auto passes = run.session.pass_images(run.request);
    if (!passes) return passes.error();
    const auto pass = std::ranges::find(*passes, stage, &PassImages::stage);
    if (pass == passes->end())
        return fail(Fault::usage, "stage.not_needed", "the frame does not need the stage {stage}", name(stage));
    Request request = run.request;
    request.outputs.clear();
    for (const auto& [image, of_truth] : truth)
        if (!pass->images.contains(image)) request.outputs.push_back(image);
    if (request.outputs.empty()) return std::move(*pass);
    auto asked = run.session.run(request);
    if (!asked) return asked.error();
    pass->images.merge(asked->images);
    return std::move(*pass);
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
    return fmt::format("{} {}{}", shown.name, value,
                       is_touched ? fmt::format(" over the {:.3g} % of the pixels that {} can change",
                                                100 * accuracy->touched_share, name(stage))
                                  : "");
}

}  // namespace

Result<TruthComparison> compare_with_truth(const RunToCompare& run, Stage stage, ErrorAt at, const ErrorLimits& limits,
                                           const SeeImages& see) {
    const auto frame = run.session.frame(run.request.variant.frame);
    if (!frame) return frame.error();
    const Variant row{.request = run.request};
    const auto truths = find_row_truths(run.session, {.base = run.request, .error_at = at, .stage = stage}, {&row, 1}, *frame);
    if (!truths) return truths.error();
    const RowTruth& truth = truths->all.front();
    auto pass = pass_of(run, stage, truth.truth);
    if (!pass) return pass.error();
    ImageSet display;
    if (at == ErrorAt::picture) {
        Request request = run.request;
        request.outputs = {picture};
        auto made = run.session.run(request);
        if (!made) return made.error();
        display.emplace(picture, truth.picture->display);
        pass->images = std::move(made->images);
    }
    auto compared = compare_images_of({{.label = pass->label, .choice_a = "the truth", .choice_b = pass->choice},
                                       std::move(pass->images),
                                       at == ErrorAt::picture ? display : truth.truth},
                                      limits, see);
    if (!compared) return compared.error();
    compared->frame = run.request.variant.frame;
    const auto error = error_text(run, stage, truth);
    if (!error) return error.error();
    compared->notes.insert(compared->notes.begin(), *error);
    return TruthComparison{*std::move(compared), fmt::format("truth of {}: {}", name(stage), truth.name)};
}

}  // namespace strata
