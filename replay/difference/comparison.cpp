#include "replay/difference/comparison.h"

#include <algorithm>

namespace strata {
namespace {

ImageComparison not_compared(const std::string& image, std::string reason) {
    return {.image = image, .verdict = Verdict::not_compared, .reason = std::move(reason)};
}

/// An image that only one run made: over tolerance, for the frames are not made of the same things.
ImageComparison in_one_alone(const std::string& image, std::string_view side) {
    return {.image = image, .verdict = Verdict::over, .reason = fmt::format("only {} has it", side)};
}

Result<ImageComparison> compare_outputs(const std::string& image, const PassImages& a, const PassImages& b,
                                        const ErrorLimits& limits) {
    const HostImage &of_a = a.images.at(image), &of_b = b.images.at(image);
    const bool other_choice = a.choice != b.choice;
    if (other_choice && content_of(image, of_a.shape.format) == Content::coded)
        return not_compared(image, "its layout is the technique's own, and the techniques or their settings differ");
    if (other_choice)
        if (const auto comparable = check_comparable(image, of_a, of_b); !comparable)
            return not_compared(image, comparable.error().sentence);
    return compare_images(image, of_a, of_b, limits);
}

Result<PassComparison> compare_passes(const PassImages& a, const PassImages& b, const ErrorLimits& limits, const SeeImages& see) {
    PassComparison pass{a.label, a.choice, b.choice, {}};
    for (const auto& [image, of_a] : a.images) {
        if (!limits.asks_for(image)) continue;
        if (!b.images.contains(image)) {
            pass.images.push_back(in_one_alone(image, "A"));
            continue;
        }
        auto made = compare_outputs(image, a, b, limits);
        if (!made) return within(made.error(), "{pass}", a.label);
        if (see && made->verdict != Verdict::not_compared)
            if (const auto seen = see(pass, *made, of_a, b.images.at(image)); !seen) return seen.error();
        pass.images.push_back(*std::move(made));
    }
    for (const auto& [image, of_b] : b.images)
        if (!a.images.contains(image) && limits.asks_for(image)) pass.images.push_back(in_one_alone(image, "B"));
    return pass;
}

/// The first step of two equal plans that wrote something else.
Result<std::string> first_step(const std::vector<StepImages>& a, const std::vector<StepImages>& b, const ErrorLimits& limits) {
    if (a.size() != b.size()) return fmt::format("the plans differ: {} steps against {}", a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i].name != b[i].name)
            return fmt::format("the plans differ from step {} on: {} against {}", a[i].step, a[i].name, b[i].name);
        for (const auto& [image, of_a] : a[i].images) {
            const auto of_b = b[i].images.find(image);
            if (of_b == b[i].images.end() || of_a.texels == of_b->second.texels) continue;
            const auto made = compare_images(image, of_a, of_b->second, limits);
            if (!made) return made.error();
            if (made->verdict == Verdict::over)
                return fmt::format("step {}, {}, writes '{}': {}", a[i].step, a[i].name, image, made->reason);
        }
    }
    return std::string("no image of a step differs: the difference begins in a buffer");
}

/// Looks into the stage of the pass that differs first.
Result<void> find_step(FrameComparison& frame, std::span<const PassImages> passes_a, const RunToCompare& a, const RunToCompare& b,
                       const ErrorLimits& limits) {
    const std::string& label = frame.divergence.pass;
    if (label.empty()) return {};
    const auto pass = std::ranges::find(frame.passes, label, &PassComparison::label);
    if (pass->choice_a != pass->choice_b) {
        frame.divergence.step =
            fmt::format("A uses {}, B {}: from here on outputs are compared, not steps",
                        pass->choice_a.empty() ? "nothing" : pass->choice_a, pass->choice_b.empty() ? "nothing" : pass->choice_b);
        return {};
    }
    const Stage stage = std::ranges::find(passes_a, label, &PassImages::label)->stage;  // both chose it alike, so both have it
    const auto steps_a = a.session.step_images(a.request, stage);
    if (!steps_a) return steps_a.error();
    const auto steps_b = b.session.step_images(b.request, stage);
    if (!steps_b) return steps_b.error();
    auto step = first_step(*steps_a, *steps_b, limits);
    if (!step) return step.error();
    frame.divergence.step = *std::move(step);
    return {};
}

}  // namespace

void add_pass(FrameComparison& frame, PassComparison pass) {
    for (ImageComparison& image : pass.images) {
        if (image.flip) {
            image.flip->map = {};
            image.flip->exposure = {};
        }
        frame.verdict = std::max(frame.verdict, image.verdict);
        if (image.verdict == Verdict::over && frame.divergence.pass.empty()) frame.divergence = {pass.label, image.image, ""};
    }
    frame.passes.push_back(std::move(pass));
}

Result<FrameComparison> compare_runs(const RunToCompare& a, const RunToCompare& b, const ErrorLimits& limits,
                                     const SeeImages& see) {
    const auto passes_a = a.session.pass_images(a.request);
    if (!passes_a) return passes_a.error();
    const auto passes_b = b.session.pass_images(b.request);
    if (!passes_b) return passes_b.error();
    FrameComparison frame{.frame = a.request.variant.frame};
    // Passes stand in the order of the frame; a stage that only one frame needs is a pass without a partner.
    auto next = passes_b->begin();
    const auto add_of_b_alone = [&](const PassImages& pass) {
        if (limits.images.empty()) add_pass(frame, {pass.label, "", pass.choice, {in_one_alone("every output", "B")}});
    };
    for (const PassImages& of_a : *passes_a) {
        const auto partner =
            std::find_if(next, passes_b->end(), [&](const PassImages& of_b) { return of_b.label == of_a.label; });
        if (partner == passes_b->end()) {
            if (limits.images.empty()) add_pass(frame, {of_a.label, of_a.choice, "", {in_one_alone("every output", "A")}});
            continue;
        }
        for (; next != partner; ++next) add_of_b_alone(*next);
        next = partner + 1;
        auto pass = compare_passes(of_a, *partner, limits, see);
        if (!pass) return pass.error();
        add_pass(frame, *std::move(pass));
    }
    for (; next != passes_b->end(); ++next) add_of_b_alone(*next);
    if (const auto found = find_step(frame, *passes_a, a, b, limits); !found) return found.error();
    return frame;
}

Result<FrameComparison> compare_image_sets(const NamedImages& a, const NamedImages& b, const ErrorLimits& limits,
                                           const SeeImages& see) {
    FrameComparison frame;
    PassComparison pass{.label = std::string(label_of_files)};
    const bool single = a.size() == 1 && b.size() == 1;
    for (const auto& [image, of_a] : a) {
        if (!single && !limits.asks_for(image)) continue;
        const auto of_b = single ? b.begin() : b.find(image);
        if (of_b == b.end())
            return fail(Fault::usage, "difference.image_missing", "{side} has an image '{image}' and {other} has none", "A",
                        image, "B");
        auto made = compare_images(image, of_a, of_b->second, limits);
        if (!made) return made.error();
        if (see)
            if (const auto seen = see(pass, *made, of_a, of_b->second); !seen) return seen.error();
        pass.images.push_back(*std::move(made));
    }
    for (const auto& [image, of_b] : b)
        if (!single && !a.contains(image) && limits.asks_for(image))
            return fail(Fault::usage, "difference.image_missing", "{side} has an image '{image}' and {other} has none", "B",
                        image, "A");
    add_pass(frame, std::move(pass));
    return frame;
}

Verdict verdict(const Comparison& comparison) {
    Verdict worst = Verdict::same;
    for (const FrameComparison& frame : comparison.frames) worst = std::max(worst, frame.verdict);
    return worst;
}

std::string case_name(std::size_t frame, const PassComparison& pass, const ImageComparison& image) {
    std::string name = fmt::format("f{:04}.{}.{}", frame, pass.label, image.image);
    std::ranges::replace(name, ' ', '_');
    std::ranges::replace(name, '/', '_');
    return name;
}

}  // namespace strata
