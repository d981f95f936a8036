#include "ui/compare/compare_side.h"

#include <algorithm>
#include <set>

#include <fmt/ranges.h>

#include "capture_format/reader.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/expectations/expectation_check.h"
#include "replay/images/image_io.h"

namespace strata::ui {
namespace {

bool is_replay(Source source) {
    return source == Source::replay || source == Source::recorded || source == Source::kept || source == Source::variant;
}

Result<SidePicture> picture_after(Session& session, const Request& request, const Subject& subject) {
    auto passes = session.pass_images(request);
    if (!passes) return passes.error();
    for (std::size_t i = passes->size(); i-- > 0;) {
        PassImages& pass = (*passes)[i];
        const auto image = pass.images.find(subject.image);
        if (image == pass.images.end() || (subject.after && pass.stage != *subject.after)) continue;
        return SidePicture{.image = std::make_shared<HostImage>(std::move(image->second)), .about = pass.choice};
    }
    return fail(Fault::usage, "frame.no_output", "the stage {stage} writes no '{output}' in this frame", name(*subject.after),
                subject.image);
}

std::string images_with_truth() {
    std::set<std::string_view> images;
    for (const StageInfo& stage : stages())
        if (stage.truth) images.insert(stage.outputs.begin(), stage.outputs.end());
    return fmt::format("{}", fmt::join(images, ", "));
}

Result<SidePicture> true_picture(Session& session, const Request& request, const Subject& subject) {
    if (!subject.after)
        return fail(Fault::usage, "stage.no_truth",
                    "no stage that writes '{image}' in this frame has a truth; images with a truth: {known}", subject.image,
                    images_with_truth());
    const StageInfo& stage = info(*subject.after);
    if (!stage.truth) return fail(Fault::usage, "stage.no_truth", "no reference solution exists for stage {stage}", stage.name);
    const auto truth = session.truth(request, stage.stage);
    if (!truth) return truth.error();
    const auto image = truth->find(subject.image);
    if (image == truth->end())
        return fail(Fault::usage, "stage.no_truth_of_image", "the truth of {stage} has no '{image}'", stage.name, subject.image);
    SidePicture made = picture_of(image->second);
    made.about = fmt::format("truth of {}, in double", stage.name);
    return made;
}

/// This device's newest of the frame and its choices, else the newest of any device.
const Expectation* best_of(std::span<const Expectation> all, const Expectation& got) {
    if (const auto own = accepted_for(all, got); !own.empty()) return own.front();
    const auto same = [&](const Expectation& each) { return same_frame_and_choices(each, got); };
    const auto found = std::find_if(all.rbegin(), all.rend(), same);
    return found == all.rend() ? nullptr : &*found;
}

Result<SidePicture> kept_picture(const Capture& capture, const ExpectedImage& image, const Expectation& expected) {
    return capture.expected_image(image.texels, bytes(image.shape)).and_then([&](auto& texels) {
        return SidePicture{.image = std::make_shared<HostImage>(HostImage{image.shape, std::move(texels)}),
                           .about = fmt::format("expected on {}", text(expected.on))};
    });
}

}  // namespace

Request variant_of(Request request, const Technique& technique, const Settings& settings) {
    request.choices.drop(technique.stage);
    request.choices.use(technique);
    for (const Param& param : settings.params())
        request.choices.settings.push_back({&technique, std::string(param.name), settings.get(param.name)});
    return request;
}

std::optional<Stage> stage_of_truth(const std::string& image, std::span<const SkippedStage> skipped) {
    for (std::size_t i = stages().size(); i-- > 0;) {
        const StageInfo& stage = stages()[i];
        const bool writes = std::ranges::find(stage.outputs, image) != stage.outputs.end();
        const bool runs = std::ranges::find(skipped, stage.stage, &SkippedStage::stage) == skipped.end();
        if (writes && runs && stage.truth) return stage.stage;
    }
    return {};
}

Result<SidePicture> expected_picture(Session& session, Request request, const Subject& subject) {
    if (!session.capture())
        return fail(Fault::expectation_missing, "expectation.no_capture",
                    "the frames were made in code and have no expected results");
    const auto all = expectations_of(*session.capture());
    if (!all) return all.error();
    request.outputs.clear();
    request.passes = Passes::read_back;
    const auto run = session.run(request);
    if (!run) return run.error();
    const Expectation got = expectation_of(session, request, *run);
    const Expectation* expected = best_of(*all, got);
    if (!expected)
        return fail(Fault::expectation_missing, "replay.no_expectation",
                    "the capture has no expected results for frame {frame}; 'strata accept' stores them", request.variant.frame);
    for (std::size_t i = expected->passes.size(); i-- > 0;) {
        const ExpectedPass& pass = expected->passes[i];
        const auto image = std::ranges::find(pass.images, subject.image, &ExpectedImage::name);
        if (image == pass.images.end() || (subject.after && run->passes[i].stage != *subject.after)) continue;
        if (!image->texels.empty()) return kept_picture(*session.capture(), *image, *expected);
        const auto now = run->passes[i].images.find(subject.image);
        const bool same = now != run->passes[i].images.end() && hash_of(now->second) == image->hash;
        return fail(
            Fault::expectation_missing, "expectation.hash_only",
            "only a hash of '{image}' is stored ({match} a replay as recorded on this device); 'strata accept --with-images' "
            "stores pictures",
            subject.image, same ? "it matches" : "it does not match");
    }
    return fail(Fault::expectation_missing, "expectation.no_image", "the capture has no expected result for '{image}'",
                subject.image);
}

void ComparedSide::show(const SideWish& wish, Services& services) {
    if (is_replay(wish.source) && !wish.subject.after) show_replay(wish, services);
    else show_job(wish, services);
}

void ComparedSide::show_replay(const SideWish& wish, Services& services) {
    if (job_) job_->progress.cancel();
    job_.reset();
    wish_.reset();
    services.replayer.show(place_, wish.request);
    busy_ = !services.replayer.is_current(place_);
    const Error* error = services.replayer.error(place_);
    message_ = error ? error->sentence : "";
    const auto replay = services.replayer.shown(place_);
    if (!replay || replay->request != wish.request || replay->shaders != wish.shaders) return;
    picture_.set(wish, {.image = replay->image(replay, wish.subject.image)});
    if (!picture().image) message_ = fmt::format("this frame has no '{}'", wish.subject.image);
}

void ComparedSide::show_job(const SideWish& wish, Services& services) {
    const bool is_new = !wish_ || *wish_ != wish;
    busy_ = is_new || job_ != nullptr;
    if (is_new && !ImGui::IsAnyItemActive()) start(wish, services);
    if (!job_ || !job_->result()) return;
    const Result<SidePicture>& result = *job_->result();
    message_ = result ? "" : result.error().sentence;
    picture_.set(*wish_, result ? *result : SidePicture());
    job_.reset();
}

void ComparedSide::start(const SideWish& wish, Services& services) {
    if (job_) job_->progress.cancel();
    wish_ = wish;
    message_.clear();
    if (wish.source == Source::file) {
        job_ = ui::start<SidePicture>(services.host, [wish](Progress&) { return read_picture(wish.file, wish.subject.image); });
        return;
    }
    job_ = services.replayer.start<SidePicture>([wish](Session& session, Progress&) {
        if (wish.source == Source::truth) return true_picture(session, wish.request, wish.subject);
        if (wish.source == Source::expectation) return expected_picture(session, wish.request, wish.subject);
        return picture_after(session, wish.request, wish.subject);
    });
}

}  // namespace strata::ui
