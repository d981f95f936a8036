#include "replay/session/judgment.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/reference/difference.h"
#include "passes/reference/display_light.h"
#include "passes/reference/fragments.h"
#include "passes/reference/raster.h"
#include "passes/reference/settle.h"
#include "passes/registry.h"
#include "passes/stage_input.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/measure/flip.h"
#include "replay/plural.h"
#include "replay/session/light_unit.h"
#include "replay/session/until_stopped.h"

namespace strata {
namespace {

// A texel of which every channel is below this is background: comparing it proves nothing.
constexpr double trivial_below = 1e-6;

bool is_undecided(const ReferenceImage& image, std::size_t texel) { return !image.undecided.empty() && image.undecided[texel]; }

/// Root mean square over the decided texels' colors: what errors are relative to. Texels that are not finite are left out, or one
/// infinity would make every other error 0.
double root_mean_square(const ReferenceImage& image) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const glm::dvec3 color(image.texels[i]);
        const double square = glm::dot(color, color) / 3;
        if (is_undecided(image, i) || !std::isfinite(square)) continue;
        sum += square;
        ++count;
    }
    return std::sqrt(sum / double(std::max<std::size_t>(1, count)));
}

/// Equal infinities and two NaN differ by nothing; NaN on one side is as wrong as can be.
double relative_distance(double got, double wanted, double scale) {
    if (got == wanted || (std::isnan(got) && std::isnan(wanted))) return 0;
    const double error = std::abs(got - wanted) / std::max(std::abs(wanted), scale);
    return std::isnan(error) ? HUGE_VAL : error;
}

struct Compared {
    double square_sum = 0, worst = 0;
    std::size_t texels = 0, undecided = 0, trivial = 0;
    WorstTexel where;
};

/// Two images of one shape.
void compare(std::string_view name, const ReferenceImage& got, const ReferenceImage& wanted, Compared& all) {
    const double scale = std::max(root_mean_square(wanted), 1e-9);
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        if (is_undecided(wanted, i)) {
            ++all.undecided;
            continue;
        }
        const glm::dvec4 a = got.texels[i], b = wanted.texels[i];
        if (glm::all(glm::lessThan(glm::abs(glm::dvec3(b)), glm::dvec3(trivial_below)))) ++all.trivial;
        ++all.texels;
        for (glm::length_t c = 0; c < static_cast<glm::length_t>(got.channels); ++c) {
            const double error = relative_distance(a[c], b[c], scale);
            all.square_sum += error * error / got.channels;
            if (error <= all.worst && !all.where.image.empty()) continue;
            all.worst = error;
            const auto x = static_cast<std::uint32_t>(i % wanted.width), row = static_cast<std::uint32_t>(i / wanted.width);
            all.where = {std::string(name), x, row % wanted.height, row / wanted.height, got.texels[i], wanted.texels[i]};
        }
    }
}

std::string extent_text(const ReferenceImage& image) {
    return fmt::format("{} x {} with {}", image.width, image.height, plural(image.layers, "layer"));
}

/// What only its own technique can read is compared with nothing.
bool is_coded(std::string_view image) {
    const FrameImageRow* row = find_frame_image(image);
    return row && row->content == Content::coded;
}

/// Why a result cannot be compared with the model's images, or nothing.
std::string incomparable_with_model(const StageInfo& of_stage, const ImageSet& result, const ImageSet& model) {
    if (model.empty()) return "the model gives no image of this frame";
    for (const auto& [name, wanted] : model) {
        const auto got = result.find(name);
        if (got == result.end()) return fmt::format("the model gives {}, the result does not have it", name);
        if (!same_extent(got->second, wanted))
            return fmt::format("{} is {}, the model's is {}", name, extent_text(got->second), extent_text(wanted));
        if (got->second.channels != wanted.channels)
            return fmt::format("{} has {}, the model's has {}", name, plural(got->second.channels, "channel"), wanted.channels);
    }
    for (const std::string_view output : of_stage.outputs)
        if (result.contains(output) && !model.contains(output) && !is_coded(output))
            return fmt::format("the result has {}, the model does not give it", output);
    return {};
}

/// Why a result cannot be compared with the stage's truth, or nothing.
std::string incomparable_with_truth(const StageInfo& of_stage, const ImageSet& result, const ImageSet& truth) {
    if (truth.empty()) return fmt::format("the truth of {} gives no image of this frame", of_stage.name);
    // A stage's first output is nobody's where a later stage draws over it.
    const std::string_view first = of_stage.outputs.front();
    if (result.contains(first) && !truth.contains(first))
        return fmt::format("the result has {}, the truth of {} does not", first, of_stage.name);
    for (const auto& [name, wanted] : truth) {
        if (is_coded(name)) continue;
        const auto got = result.find(name);
        if (got == result.end()) return fmt::format("the truth has {}, the result does not have it", name);
        if (!same_extent(got->second, wanted))
            return fmt::format("{} is {}, the truth's is {}", name, extent_text(got->second), extent_text(wanted));
    }
    return {};
}

/// The radiance that a stage makes, and what its truth has.
struct Radiance {
    const ReferenceImage& got;
    const ReferenceImage& wanted;
};

/// Finds them; nothing for a stage that makes no radiance.
std::optional<Radiance> radiance_of(const StageInfo& stage, const ImageSet& result, const ImageSet& truth) {
    const std::string_view picture = stage.outputs.front();
    const FrameImageRow* row = find_frame_image(picture);
    const auto got = result.find(picture), wanted = truth.find(picture);
    if (!row || row->content != Content::radiance || got == result.end() || wanted == truth.end()) return {};
    return Radiance{got->second, wanted->second};
}

/// That radiance by itself as the frame's recorded exposure and tone curve show it.
struct DisplayLight {
    ReferenceImage got, wanted;
};

DisplayLight display_light(const Radiance& radiance, const Frame& frame) {
    const auto shown = [&](const ReferenceImage& image) {
        return tone_mapped(image, double(frame.view.exposure), double(frame.film.white));
    };
    return {shown(radiance.got), shown(radiance.wanted)};
}

/// Adds errors of display light behind the figures of a judge that has none.
void add_display_errors(const DisplayError& error, std::vector<Metric>& metrics) {
    if (std::ranges::count(metrics, display_rmse, &Metric::name) > 0) return;
    metrics.push_back({display_rmse, "of white", error.rmse, true});
    metrics.push_back({"over 5/255", "%", 100 * error.over_5_255, true});
}

/// `touched`: radiance, of which what the stage leaves as it finds it is undecided.
Footing footing_of(const DisplayError& error, const ReferenceImage& touched) {
    Footing footing = strata::footing_of(error);
    double all = 0, brightest = 0;
    for (std::size_t i = 0; i < touched.texels.size(); ++i) {
        if (is_undecided(touched, i)) continue;
        const glm::dvec3 light(touched.texels[i]);
        const double energy = glm::dot(light, light);
        if (!std::isfinite(energy)) continue;
        all += energy;
        if (energy <= brightest) continue;
        brightest = energy;
        const std::size_t pixel = i % (std::size_t(touched.width) * touched.height);
        footing.x = std::uint32_t(pixel % touched.width), footing.y = std::uint32_t(pixel / touched.width);
    }
    footing.brightest_share = all > 0 ? brightest / all : 0;
    return footing;
}

/// Tells for each pixel whether a decided sample is left after keep_touched().
std::vector<bool> changed_pixels(const ReferenceImage& touched) {
    const std::size_t pixels = std::size_t(touched.width) * touched.height;
    std::vector<bool> changed(pixels);
    for (std::size_t i = 0; i < touched.texels.size(); ++i)
        if (!is_undecided(touched, i)) changed[i % pixels] = true;
    return changed;
}

void judge_by_model(const JudgedStage& stage, Accuracy& accuracy) {
    ImageSet model = run_model(stage);
    leave_out_sides(stage.frame, stage.snap_steps, model);
    accuracy.incomparable = incomparable_with_model(info(stage.choice.technique->stage), stage.result, model);
    if (!accuracy.incomparable.empty()) {
        accuracy.model_rmse = accuracy.model_worst = HUGE_VAL;
        return;
    }
    Compared all;
    for (const auto& [name, wanted] : model) compare(name, stage.result.find(name)->second, wanted, all);
    accuracy.model_rmse = std::sqrt(all.square_sum / double(std::max<std::size_t>(1, all.texels)));
    accuracy.model_worst = all.worst;
    accuracy.compared = all.texels;
    accuracy.undecided = all.undecided;
    accuracy.trivial = all.trivial;
    accuracy.worst = all.where;
}

/// Leaves out what the stage leaves as it finds it, which a step back of the camera makes more of: the share that remains;
/// nothing where nothing would remain.
std::optional<double> keep_touched(const StageInfo& stage, const ImageSet& before, ImageSet& truth) {
    const std::string_view picture = stage.outputs.front();
    ReferenceImage& wanted = truth.find(picture)->second;
    const auto found = before.find(picture);
    const bool is_drawn_over = found != before.end() && same_extent(found->second, wanted);
    return strata::keep_touched(wanted, is_drawn_over ? &found->second : nullptr);
}

/// By more than rounding: a truth that is kept for several rows was scaled to the frame's unit of light and back.
bool differ(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::any(glm::greaterThan(glm::abs(a - b), 0x1p-21 * glm::max(glm::abs(a), glm::abs(b))));
}

/// 0 where there is no such image.
double undecided_share(const ImageSet& truth, std::string_view image) {
    const auto found = truth.find(image);
    return found == truth.end() ? 0 : undecided_share(found->second);
}

/// The figures that the stage's judge would give, every one infinite.
std::vector<Metric> infinite_metrics(const StageInfo& of_stage, const ImageSet& truth, const StageInput& input) {
    if (!truth.contains(of_stage.outputs.front())) return {{"error", "", HUGE_VAL}};
    std::vector<Metric> metrics = of_stage.judge(truth, truth, input);
    if (const auto radiance = radiance_of(of_stage, truth, truth)) add_display_errors({}, metrics);
    for (Metric& metric : metrics) metric.value = HUGE_VAL;
    return metrics;
}

void judge_by_truth(const JudgedStage& stage, Accuracy& accuracy) {
    const StageInfo& of_stage = info(stage.choice.technique->stage);
    const StageInput input{stage.frame, stage.before, stage.fragments};
    ImageSet truth;
    const bool is_made = until_stopped(stage.stop, [&] {
        truth = stage.truth ? *stage.truth : truth_of(*stage.choice.technique, stage.choice.settings).make(input);
    });
    if (!is_made) return;
    leave_out_sides(stage.frame, stage.snap_steps, truth);
    if (const std::string why = incomparable_with_truth(of_stage, stage.result, truth); !why.empty()) {
        accuracy.incomparable += accuracy.incomparable.empty() ? why : "; " + why;
        accuracy.technique_errors = infinite_metrics(of_stage, truth, input);
        return;
    }
    accuracy.undecided_share = undecided_share(truth, of_stage.outputs.front());
    if (of_stage.settle && accuracy.undecided_share > 0) accuracy.undecided_bound = of_stage.settle(stage.result, truth);
    accuracy.unjudged_share = undecided_share(truth, of_stage.outputs.front());
    if (accuracy.unjudged_share == 1) {
        accuracy.not_supported = "no sample can be judged: rounding decides what each of them shows";
        return;
    }
    const auto wanted = truth.find(of_stage.outputs.front());
    const auto got = stage.result.find(of_stage.outputs.front());
    if (wanted != truth.end() && got != stage.result.end() && same_extent(got->second, wanted->second)) {
        accuracy.not_numbers = leave_out_not_numbers(got->second, wanted->second);
        if (accuracy.not_numbers > 0 && undecided_share(wanted->second) == 1) {
            accuracy.not_supported = nothing_but_not_numbers(accuracy.not_numbers, "sample");
            return;
        }
    }
    accuracy.technique_errors = of_stage.judge(stage.result, truth, input);
    const auto radiance = radiance_of(of_stage, stage.result, truth);
    if (!radiance) return;
    const DisplayLight light = display_light(*radiance, stage.frame);  // before samples that the stage leaves are left out
    add_display_errors(display_error(light.got, light.wanted), accuracy.technique_errors);
    accuracy.flip = radiance_flip(color_planes(radiance->wanted), color_planes(radiance->got)).mean;
    accuracy.footing.emplace();  // no pixel
    if (const auto share = keep_touched(of_stage, stage.before, truth)) {
        accuracy.touched_share = *share;
        accuracy.touched = of_stage.judge(stage.result, truth, input);
        const DisplayError error = display_error(light.got, light.wanted, changed_pixels(radiance->wanted));
        add_display_errors(error, accuracy.touched);
        accuracy.footing = footing_of(error, radiance->wanted);
    }
}

}  // namespace

bool same_extent(const ReferenceImage& a, const ReferenceImage& b) {
    return a.width == b.width && a.height == b.height && a.layers == b.layers && a.texels.size() == b.texels.size();
}

Footing footing_of(const DisplayError& error) {
    return {.pixels = error.pixels, .clipped_share = error.clipped_share, .concentration = error.concentration};
}

std::optional<double> keep_touched(ReferenceImage& image, const ReferenceImage* before) {
    image.undecided.resize(image.texels.size());
    std::vector<bool> keeps_alternatives = has_alternatives(image);
    std::size_t touched = 0, kept = 0;
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const bool is_touched = differ(glm::dvec3(image.texels[i]), before ? glm::dvec3(before->texels[i]) : glm::dvec3(0));
        touched += is_touched;
        image.undecided[i] = image.undecided[i] || !is_touched;
        keeps_alternatives[i] = keeps_alternatives[i] && is_touched;
        kept += !image.undecided[i] || keeps_alternatives[i];
    }
    std::erase_if(image.alternatives, [&](const Alternative& other) { return !keeps_alternatives[other.texel]; });
    return kept == 0 ? std::nullopt : std::optional(double(touched) / double(image.texels.size()));
}

std::size_t leave_out_not_numbers(const ReferenceImage& got, ReferenceImage& wanted) {
    std::size_t count = 0;
    wanted.undecided.resize(wanted.texels.size());
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        if (!decided(got, wanted, i)) continue;
        const auto result = glm::isnan(glm::dvec3(got.texels[i])), truth = glm::isnan(glm::dvec3(wanted.texels[i]));
        if (!(result.x && truth.x) && !(result.y && truth.y) && !(result.z && truth.z)) continue;
        wanted.undecided[i] = true;
        ++count;
    }
    return count;
}

std::string nothing_but_not_numbers(std::size_t count, std::string_view of) {
    return fmt::format("no {} can be judged: {} of them are NaN in the result and in the truth", of, count);
}

double undecided_share(const ReferenceImage& image) {
    const std::vector<bool>& undecided = image.undecided;
    return undecided.empty() ? 0 : double(std::ranges::count(undecided, true)) / double(undecided.size());
}

void leave_out_sides(const Frame& frame, std::uint32_t device_snap_steps, ImageSet& images) {
    if (device_snap_steps >= snap_steps) return;
    const double finer = double(snap_steps) / double(device_snap_steps);
    const std::vector<bool> near = samples_near_sides(frame, undecided_steps * finer);
    const View& view = frame.view;
    for (auto& [name, image] : images) {
        if (image.width != view.width || image.height != view.height) continue;
        image.undecided.resize(image.texels.size());
        image.alternatives.clear();  // those that finer steps allow
        const std::size_t pixels = std::size_t(view.width) * view.height;
        for (std::size_t i = 0; i < near.size(); ++i)
            if (const std::size_t texel = image.layers == view.samples ? i : i % pixels; near[i]) image.undecided[texel] = true;
    }
}

void scale_light(Accuracy& accuracy, double factor) {
    for (std::vector<Metric>* metrics : {&accuracy.technique_errors, &accuracy.touched})
        for (Metric& metric : *metrics)
            if (metric.unit == "radiance") metric.value *= factor;
    if (!holds_radiance(accuracy.worst.image)) return;
    for (glm::dvec4* texel : {&accuracy.worst.got, &accuracy.worst.wanted})
        *texel = glm::dvec4(glm::dvec3(*texel) * factor, texel->w);
}

ImageSet run_model(const JudgedStage& stage) {
    const Technique& technique = *stage.choice.technique;
    if (!technique.model) return {};
    return technique.model({stage.frame, stage.before, stage.fragments, stage.rounding}, stage.choice.settings);
}

Accuracy judge_stage(const JudgedStage& stage) {
    Accuracy accuracy;
    const Technique& technique = *stage.choice.technique;
    accuracy.not_supported = unsupported_because(technique, stage.features);
    if (!accuracy.not_supported.empty()) return accuracy;
    if (stage.against != Against::truth) judge_by_model(stage, accuracy);
    if (stage.against != Against::model && !stage.stop.stop_requested()) judge_by_truth(stage, accuracy);
    return accuracy;
}

}  // namespace strata
