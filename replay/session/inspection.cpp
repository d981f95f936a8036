// Looking inside a frame: what passes and steps gave, what a stage found, and how it fares against model and truth.
#include <algorithm>
#include <set>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "capture_format/view.h"
#include "passes/indirect/volume_light.h"
#include "passes/stage_input.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/measure/host_memory.h"
#include "replay/session/describe_run.h"
#include "replay/session/device_session.h"
#include "replay/session/judgment.h"
#include "replay/session/light_unit.h"
#include "replay/session/until_stopped.h"

namespace strata {
namespace {

/// The last step up to `end` that writes the image, or nothing.
std::optional<std::size_t> last_write(const Plan& plan, Image image, std::size_t end) {
    for (std::size_t i = std::min(end, plan.steps.size()); i-- > 0;)
        if (std::ranges::count(images_written(plan.steps[i].step), image.id, &Image::id) > 0) return i;
    return {};
}

/// Scopes are in the order of the steps.
std::size_t first_step_after(const Plan& plan, std::uint32_t scope) {
    const auto at = std::ranges::find_if(plan.steps, [&](const PlannedStep& s) { return s.step.scope > scope; });
    return static_cast<std::size_t>(at - plan.steps.begin());
}

/// Places of a plan to look at; one that is wanted twice is read once.
class Peeks {
public:
    std::size_t add(std::size_t step, Image image) {
        const auto same = [&](const Peek& peek) { return peek.step == step && peek.image.id == image.id; };
        const auto known = std::ranges::find_if(peeks_, same);
        if (known != peeks_.end()) return static_cast<std::size_t>(known - peeks_.begin());
        peeks_.push_back({step, image});
        return peeks_.size() - 1;
    }
    RunOptions options() const { return {.peeks = peeks_, .kept_images = KeptImages::left}; }

private:
    std::vector<Peek> peeks_;
};

/// An image by its name and its index among the peeked ones.
struct PeekedImage {
    std::string name;
    std::size_t peek = 0;
};

/// The frame's images as a pass left them: a later one may have put others in their place.
const FrameImages& images_after(const Declaration& d, std::size_t pass) {
    return pass + 1 < d.frame.passes.size() ? d.frame.passes[pass + 1].before : d.images;
}

/// The outputs of its stage that a pass writes, after its last step.
std::vector<PeekedImage> peek_outputs(const Declaration& d, std::size_t place, Peeks& peeks) {
    const DeclaredPass& pass = d.frame.passes[place];
    std::vector<PeekedImage> places;
    for (const std::string_view output : info(pass.technique->stage).outputs) {
        const Image image = images_after(d, place).*find_frame_image(output)->member;
        if (!image || d.graph.shape(image).samples > 1) continue;
        const auto step = last_write(d.plan, image, first_step_after(d.plan, pass.scope));
        if (step && d.plan.steps[*step].step.scope == pass.scope)
            places.push_back({std::string(output), peeks.add(*step, image)});
    }
    return places;
}

/// How many passes stand before the last one of a stage's technique; nothing when it has none.
std::optional<std::size_t> before_last_pass(const Declaration& d, Stage stage) {
    for (std::size_t i = d.frame.passes.size(); i-- > 0;)
        if (d.frame.passes[i].technique->stage == stage) return i;
    return {};
}

/// The last scope of a pass: what the memo keeps of it, or puts in its place, is in one of its own.
std::uint32_t end_scope(const Declaration& d, const DeclaredPass& pass) {
    const bool in_memo = pass.scope + 1 < d.graph.scopes().size() && d.graph.scopes()[pass.scope + 1].kind == ScopeKind::memo;
    return pass.scope + (in_memo ? 1 : 0);
}

/// Whether a step belongs to the stage's technique: what another stage drew over its output later is not its result.
bool is_step_of(const Declaration& d, Stage stage, std::size_t step) {
    const std::uint32_t scope = d.plan.steps[step].step.scope;
    return std::ranges::any_of(d.frame.passes, [&](const DeclaredPass& pass) {
        return pass.technique->stage == stage && (pass.scope == scope || end_scope(d, pass) == scope);
    });
}

/// The images of one sample that a step writes.
std::vector<Image> written_by(const Declaration& d, const PlannedStep& planned) {
    std::vector<Image> written = images_written(planned.step);
    std::erase_if(written, [&](Image image) { return d.graph.shape(image).samples > 1; });
    return written;
}

/// The texel of an image that shows a pixel of the frame: of one that covers it, at full extent or a pixel for each k x k.
std::optional<glm::uvec2> texel_under(const Shape& shape, const Extent& frame, glm::uvec2 pixel) {
    const std::uint32_t k = (frame.width + shape.extent.width - 1) / shape.extent.width;
    const Extent covering{(frame.width + k - 1) / k, (frame.height + k - 1) / k, 1};
    if (covering.width != shape.extent.width || covering.height != shape.extent.height) return {};
    return pixel / k;
}

/// An output of a stage and the step after which it is what the stage made of it.
struct LeftOutput {
    std::string_view name;
    Image image;
    std::size_t step = 0;
};

/// Outputs as a pass leaves them. `lacks`: the plan has no step for one that the pass made, as the memo put a later stage's in
/// its place.
struct LeftOutputs {
    std::vector<LeftOutput> all;
    bool lacks = false;
};

LeftOutputs outputs_left_by(const Declaration& d, std::size_t place) {
    const DeclaredPass& pass = d.frame.passes[place];
    const Stage stage = pass.technique->stage;
    const std::size_t end = first_step_after(d.plan, end_scope(d, pass));
    LeftOutputs left;
    for (const std::string_view output : info(stage).outputs) {
        Image FrameImages::*const member = find_frame_image(output)->member;
        const Image image = images_after(d, place).*member;
        if (!image || d.graph.shape(image).samples > 1) continue;
        const auto step = last_write(d.plan, image, end);
        if (step && is_step_of(d, stage, *step)) left.all.push_back({output, image, *step});
        else left.lacks = left.lacks || image != pass.before.*member;
    }
    return left;
}

PassImages describe_pass(const Declaration& d, const DeclaredPass& pass) {
    const Stage stage = pass.technique->stage;
    std::string label(name(stage));
    if (pass.at != stage) label += fmt::format(" at {}", name(pass.at));
    return {stage, pass.at, std::move(label), choice_line(d.choices.at(stage)), {}};
}

}  // namespace

Result<HostImage> DeviceSession::peek(const Request& request, std::size_t step, const std::string& image) {
    const auto declared = prepare(request, nullptr, Keep::outputs);
    if (!declared) return declared.error();
    const Plan& plan = declared->plan;
    if (step >= plan.steps.size())
        return fail(Fault::usage, "session.no_step", "the plan has {steps} steps; there is no step {step}", plan.steps.size(),
                    step);
    const Image handle = declared->graph.find_image(image);
    if (!handle) return fail(Fault::usage, "frame.unknown_image", "the frame has no image '{image}'", image);
    if (!last_write(plan, handle, step + 1))
        return fail(Fault::usage, "session.not_written_yet", "'{image}' is not written yet after step {step}", image, step);
    return execute(*declared, {.until = step, .peeks = {{step, handle}}}).and_then([&](auto& execution) {
        return as_recorded(image, std::move(execution.peeked.front()));
    });
}

Result<DeviceSession::Inspected> DeviceSession::inspect(const Request& request, Stage stage, FoundImages found) {
    // Under a memory budget what the memo may hold depends on the peeks, which depend on the plan: then everything is executed.
    auto declared = prepare(request, memory_budget_ == 0 ? &memo_ : nullptr, Keep::all_images);
    if (!declared) return declared.error();
    const auto passes_before = before_last_pass(*declared, stage);
    std::vector<std::uint64_t> keys = declared->pass_keys;
    if (passes_before) keys.resize(std::min(keys.size(), *passes_before));
    const bool is_known = found_ && !keys.empty() && found_->keys == keys;
    const bool reads_found = passes_before && !is_known && found == FoundImages::read;
    if (!passes_before || reads_found || outputs_left_by(*declared, *passes_before).lacks) {
        memo_.drop_unfilled();
        if (!passes_before)
            return fail(Fault::usage, "stage.not_needed", "the frame does not need the stage {stage}", name(stage));
        // A stage taken from the memo leaves out images that only its own steps would have read or drawn over.
        declared = prepare(request, nullptr, Keep::all_images);
        if (!declared) return declared.error();
    }
    const Declaration& d = *declared;
    const DeclaredPass* last = &d.frame.passes[*passes_before];
    Peeks peeks;
    std::vector<PeekedImage> before, result;
    const auto want = [&](std::vector<PeekedImage>& places, std::string_view image_name, Image image, std::size_t end) {
        if (!image || d.graph.shape(image).samples > 1) return;
        if (const auto step = last_write(d.plan, image, end))
            places.push_back({std::string(image_name), peeks.add(*step, image)});
    };
    for (const FrameImageRow& row : frame_images())
        if (reads_found) want(before, row.name, last->before.*row.member, first_step_after(d.plan, last->scope - 1));
    for (const LeftOutput& output : outputs_left_by(d, *passes_before).all)
        result.push_back({std::string(output.name), peeks.add(output.step, output.image)});

    const auto execution = execute(d, peeks.options());
    if (!execution) return execution.error();
    remember(d, *execution);
    const auto read = [&](const std::vector<PeekedImage>& places, std::string_view pass, ImageSet& images,
                          std::vector<LightFault>& faults) {
        for (const PeekedImage& image : places) {
            const HostImage& stored = execution->peeked[image.peek];
            const ReferenceImage& values = images.emplace(image.name, in_double(stored)).first->second;
            for (LightFault& fault : light_faults(image.name, stored.shape.format, values, pre_exposure())) {
                fault.pass = pass;
                faults.push_back(std::move(fault));
            }
        }
    };
    if (reads_found) {
        found_.emplace(Found{std::move(keys), {}, {}, {}});
        read(before, "the stages before it", found_->images, found_->light_faults);
    }
    Inspected inspected{.choice = d.choices.at(stage), .result = {}, .light_faults = {}};
    if (found == FoundImages::read) inspected.light_faults = found_->light_faults;
    read(result, name(stage), inspected.result, inspected.light_faults);
    return inspected;
}

Result<Run> DeviceSession::run_with_passes(const Request& request) {
    auto declared = prepare(request, nullptr, Keep::all_images);
    if (!declared) return declared.error();
    const Declaration& d = *declared;
    Peeks peeks;
    std::vector<PeekedImage> outputs;
    std::vector<std::vector<PeekedImage>> of_passes;
    for (const auto& [output, image] : d.outputs)
        if (const auto step = last_write(d.plan, image, d.plan.steps.size()))
            outputs.push_back({output, peeks.add(*step, image)});
    std::vector<PeekedImage> tables;
    for (const auto& [output, source] : d.tables)
        if (const auto step = last_write(d.plan, source.second, d.plan.steps.size()))
            tables.push_back({output, peeks.add(*step, source.second)});
    for (std::size_t pass = 0; pass < d.frame.passes.size(); ++pass) of_passes.push_back(peek_outputs(d, pass, peeks));

    const auto execution = execute(d, peeks.options());
    if (!execution) return execution.error();
    Run run = finished(d, *execution);
    for (const PeekedImage& image : outputs)
        run.images.emplace(image.name, as_recorded(image.name, execution->peeked[image.peek]));
    for (const PeekedImage& table : tables)
        run.tables.emplace(table.name, table_of(*d.tables.at(table.name).first, execution->peeked[table.peek]));
    for (std::size_t i = 0; i < of_passes.size(); ++i) {
        run.passes.push_back(describe_pass(d, d.frame.passes[i]));
        for (const PeekedImage& image : of_passes[i]) {
            if (request.light == LightCheck::on) check_light(d, i, image.name, execution->peeked[image.peek], run);
            run.passes.back().images.emplace(image.name, as_recorded(image.name, execution->peeked[image.peek]));
        }
    }
    return run;
}

std::vector<DeviceSession::LightPeek> DeviceSession::peek_at_light(const Declaration& d, RunOptions& options) {
    Peeks peeks;
    std::vector<LightPeek> light;
    for (std::size_t pass = 0; pass < d.frame.passes.size(); ++pass)
        for (PeekedImage& image : peek_outputs(d, pass, peeks))
            if (holds_light(image.name)) light.push_back({pass, std::move(image.name), image.peek});
    const std::vector<Peek> all = peeks.options().peeks;
    std::erase_if(light, [&](const LightPeek& at) { return options.until && all[at.peek].step > *options.until; });
    for (LightPeek& at : light) {
        options.peeks.push_back(all[at.peek]);
        at.peek = options.peeks.size() - 1;
    }
    return light;
}

void DeviceSession::check_light(const Declaration& d, std::size_t pass, std::string_view name, const HostImage& image,
                                Run& run) const {
    for (LightFault& fault : light_faults(name, image, pre_exposure())) {
        fault.pass = describe_pass(d, d.frame.passes[pass]).label;
        run.light_faults.push_back(std::move(fault));
    }
}

Result<std::vector<StepImages>> DeviceSession::step_images(const Request& request, Stage stage) {
    const auto declared = prepare(request, nullptr, Keep::all_images);
    if (!declared) return declared.error();
    const Plan& plan = declared->plan;
    std::set<std::uint32_t> scopes;
    for (const DeclaredPass& pass : declared->frame.passes)
        if (pass.technique->stage == stage) scopes.insert(pass.scope);
    std::vector<StepImages> steps;
    RunOptions options{.kept_images = KeptImages::left};
    std::vector<std::size_t> places;  // of each peek, in steps
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const Step& step = plan.steps[i].step;
        if (!scopes.contains(step.scope)) continue;
        for (const Image image : written_by(*declared, plan.steps[i])) {
            options.peeks.push_back({i, image});
            places.push_back(steps.size());
        }
        steps.push_back({i, plan.scopes[step.scope], step.name, {}});
    }
    auto execution = execute(*declared, options);
    if (!execution) return execution.error();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::string& image = plan.images[options.peeks[i].image.id].name;
        steps[places[i]].images.emplace(image, as_recorded(image, std::move(execution->peeked[i])));
    }
    return steps;
}

Result<std::vector<StepImages>> DeviceSession::pixel_steps(const Request& request, glm::uvec2 pixel) {
    const auto declared = prepare(request, nullptr, Keep::outputs);
    if (!declared) return declared.error();
    const Extent& frame = declared->images.extent;
    if (pixel.x >= frame.width || pixel.y >= frame.height)
        return fail(Fault::usage, "frame.no_pixel", "the frame is {width} x {height}; there is no pixel {x}, {y}", frame.width,
                    frame.height, pixel.x, pixel.y);
    const Plan& plan = declared->plan;
    RunOptions options{.kept_images = KeptImages::left};
    for (std::size_t i = 0; i < plan.steps.size(); ++i)
        for (const Image image : written_by(*declared, plan.steps[i]))
            if (const auto texel = texel_under(declared->graph.shape(image), frame, pixel))
                options.peeks.push_back({i, image, texel});
    auto execution = execute(*declared, options);
    if (!execution) return execution.error();
    std::vector<StepImages> steps;
    for (std::size_t i = 0; i < options.peeks.size(); ++i) {
        const Peek& peek = options.peeks[i];
        const Step& step = plan.steps[peek.step].step;
        if (steps.empty() || steps.back().step != peek.step) steps.push_back({peek.step, plan.scopes[step.scope], step.name, {}});
        const std::string& image = plan.images[peek.image.id].name;
        steps.back().images.emplace(image, as_recorded(image, std::move(execution->peeked[i])));
    }
    return steps;
}

Result<std::vector<Cover>> DeviceSession::draw_cover(const Request& request, std::uint32_t draw) {
    Request for_depth = request;
    for_depth.outputs = {"depth_layers"};
    const auto run = this->run(for_depth);
    if (!run) return run.error();
    const Frame& frame = loaded_->frame;
    const std::size_t count = frame.draws.size() + frame.emitters.size();
    if (draw >= count)
        return fail(Fault::usage, "frame.no_draw", "the frame has {draws} draws and emitters; there is no draw {draw}", count,
                    draw);
    const auto depth = run->images.find("depth_layers");
    if (depth == run->images.end()) return strata::draw_cover(frame, draw, nullptr);
    const ReferenceImage layers = in_double(depth->second);
    return strata::draw_cover(frame, draw, &layers);
}

void DeviceSession::drop_large_fragments(std::uint64_t most) {
    if (!found_ || !found_->fragments || found_->fragments->total() * sizeof(Fragment) <= most) return;
    found_->fragments.reset();
    release_freed_memory();
}

Result<ImageSet> DeviceSession::stage_images(const Request& request, Stage stage) {
    auto inspected = inspect(request, stage, FoundImages::not_read);
    if (!inspected) return inspected.error();
    scale_light(inspected->result, 1 / pre_exposure());
    return std::move(inspected->result);
}

Result<ImageSet> DeviceSession::truth(const Request& request, Stage stage) {
    const auto inspected = inspect(request, stage);
    if (!inspected) return inspected.error();
    if (const auto on = check_going(); !on) return on.error();
    const Choice& choice = inspected->choice;
    ImageSet images;
    const bool is_made = until_stopped(stop_, [&] {
        images = truth_of(*choice.technique, choice.settings).make({loaded_->frame, found_->images, &found_->fragments});
    });
    if (!is_made) {
        found_->fragments.reset();  // rows are missing
        return check_going().error();
    }
    leave_out_sides(loaded_->frame, device().snap_steps, images);
    drop_large_fragments(memo_budget_bytes);
    scale_light(images, 1 / pre_exposure());
    return images;
}

std::optional<std::string> DeviceSession::lacking(const Request& request, Stage stage) const {
    if (!loaded_) return std::nullopt;
    const auto choices = choose(loaded_->frame, request.choices);
    if (!choices || !choices->contains(stage)) return std::nullopt;
    const FrameImages images{.recorded = &loaded_->frame,
                             .features = &loaded_->features,
                             .facts = &loaded_->facts,
                             .capabilities = device().capabilities};
    const auto beyond = beyond_device(choices->at(stage), images);
    return beyond ? std::optional(beyond->sentence) : std::nullopt;
}

Result<Accuracy> DeviceSession::judge(const Request& request, Stage stage, Against against, const ImageSet* truth) {
    const auto inspected = inspect(request, stage);
    if (!inspected) {
        // A loop over techniques goes on to the next one.
        const auto why = inspected.error().fault == Fault::device_lacks ? lacking(request, stage) : std::nullopt;
        if (why) return Accuracy{.not_supported = *why};
        return inspected.error();
    }
    const auto rounding = against == Against::truth ? Result(BlendRounding()) : this->rounding();
    if (!rounding) return rounding.error();
    ImageSet scaled_truth;
    Accuracy accuracy = judge_stage({.frame = loaded_->frame,
                                     .features = loaded_->features,
                                     .choice = inspected->choice,
                                     .before = found_->images,
                                     .result = inspected->result,
                                     .against = against,
                                     .truth = truth ? &in_unit(pre_exposure(), *truth, scaled_truth) : nullptr,
                                     .fragments = &found_->fragments,
                                     .rounding = *rounding,
                                     .snap_steps = device().snap_steps,
                                     .stop = stop_});
    drop_large_fragments(memo_budget_bytes);
    if (const auto on = check_going(); !on) {
        found_->fragments.reset();  // rows may be missing
        return on.error();
    }
    scale_light(accuracy, 1 / pre_exposure());
    accuracy.light_faults = inspected->light_faults;
    return accuracy;
}

Result<const FragmentLists*> DeviceSession::transparent_fragments(const Request& request) {
    const auto inspected = inspect(request, Stage::transparency);
    if (!inspected) return inspected.error();
    if (const auto on = check_going(); !on) return on.error();
    if (!found_->fragments) {
        const auto depth = found_->images.find("depth_layers");
        const View& view = loaded_->frame.view;
        found_->fragments = strata::transparent_fragments(
            loaded_->frame, depth != found_->images.end() ? depth->second : ReferenceImage(view.width, view.height, view.samples),
            {}, indirect::volume_light(loaded_->frame, found_->images));
    }
    if (pre_exposure() == 1) return &*found_->fragments;
    recorded_fragments_ = found_->fragments;
    recorded_fragments_->scale_light(1 / pre_exposure());
    return &*recorded_fragments_;
}

Result<const FragmentLists*> DeviceSession::row_fragments(const Request& request, std::uint32_t y) {
    Request for_fragments = request;
    for_fragments.outputs = {"depth_layers", "volume_light"};
    for_fragments.once = true;  // to fill the memo, the frame would be executed whole
    const auto run = this->run(for_fragments);
    if (!run) return run.error();
    if (std::ranges::count(run->skipped, Stage::transparency, &SkippedStage::stage) > 0)
        return fail(Fault::usage, "stage.not_needed", "the frame does not need the stage {stage}", name(Stage::transparency));
    ImageSet before;
    for (const auto& [name, image] : run->images) before.emplace(name, in_double(image));
    const auto depth = before.find("depth_layers");
    const View& view = loaded_->frame.view;
    recorded_fragments_ = strata::transparent_fragments(
        loaded_->frame, depth != before.end() ? depth->second : ReferenceImage(view.width, view.height, view.samples),
        {y, y == ~0u ? y : y + 1}, indirect::volume_light(loaded_->frame, before));
    recorded_fragments_->scale_light(1 / pre_exposure());
    return &*recorded_fragments_;
}

}  // namespace strata
