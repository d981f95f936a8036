#include "replay/judgement.h"

#include <cmath>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "replay/measure/flip.h"

namespace strata {
namespace {

// A texel of which every channel is below this is background: comparing it proves nothing.
constexpr double trivial_below = 1e-6;

/// Root mean square over the decided texels' colors: what errors are relative to.
double root_mean_square(const ReferenceImage& image) {
    double sum = 0;
    for (const glm::dvec4& t : image.texels) sum += glm::dot(glm::dvec3(t), glm::dvec3(t)) / 3;
    return std::sqrt(sum / double(std::max<std::size_t>(1, image.texels.size())));
}

struct Compared {
    double square_sum = 0, worst = 0;
    std::size_t texels = 0, undecided = 0, trivial = 0;
    WorstTexel where;
};

/// The channels that the result has.
void compare(std::string_view name, const ReferenceImage& got, const ReferenceImage& wanted, Compared& all) {
    const double scale = std::max(root_mean_square(wanted), 1e-9);
    for (std::size_t i = 0; i < wanted.texels.size() && i < got.texels.size(); ++i) {
        if (!wanted.undecided.empty() && wanted.undecided[i]) {
            ++all.undecided;
            continue;
        }
        const glm::dvec4 a = got.texels[i], b = wanted.texels[i];
        if (glm::all(glm::lessThan(glm::abs(glm::dvec3(b)), glm::dvec3(trivial_below)))) ++all.trivial;
        ++all.texels;
        for (glm::length_t c = 0; c < static_cast<glm::length_t>(got.channels); ++c) {
            double error = std::abs(a[c] - b[c]) / std::max(std::abs(b[c]), scale);
            if (std::isnan(error)) error = std::isnan(a[c]) && std::isnan(b[c]) ? 0 : HUGE_VAL;
            all.square_sum += error * error / got.channels;
            if (error <= all.worst && !all.where.image.empty()) continue;
            all.worst = error;
            const auto x = static_cast<std::uint32_t>(i % wanted.width), row = static_cast<std::uint32_t>(i / wanted.width);
            all.where = {std::string(name), x, row % wanted.height, row / wanted.height, got.texels[i], wanted.texels[i]};
        }
    }
}

/// How different the stage's picture looks from its truth; of stages that make radiance.
std::optional<double> flip_of(const StageInfo& stage, const ImageSet& result, const ImageSet& truth) {
    const std::string_view picture = stage.outputs.front();
    const FrameImageRow* row = find_frame_image(picture);
    const auto got = result.find(picture), wanted = truth.find(picture);
    if (!row || row->content != Content::radiance || got == result.end() || wanted == truth.end()) return {};
    return radiance_flip(color_planes(wanted->second), color_planes(got->second)).mean;
}

void judge_by_model(const JudgedStage& stage, Accuracy& accuracy) {
    Compared all;
    for (const auto& [name, wanted] : run_model(stage))
        if (const auto got = stage.result.find(name); got != stage.result.end()) compare(name, got->second, wanted, all);
    accuracy.model_rmse = std::sqrt(all.square_sum / double(std::max<std::size_t>(1, all.texels)));
    accuracy.model_worst = all.worst;
    accuracy.compared = all.texels;
    accuracy.undecided = all.undecided;
    accuracy.trivial = all.trivial;
    accuracy.worst = all.where;
}

void judge_by_truth(const JudgedStage& stage, Accuracy& accuracy) {
    const StageInfo& of_stage = info(stage.choice.technique->stage);
    const StageInput input{stage.frame, stage.before, stage.fragments};
    const ImageSet own = stage.truth ? ImageSet() : of_stage.truth(input);
    const ImageSet& truth = stage.truth ? *stage.truth : own;
    accuracy.method = of_stage.judge(stage.result, truth, input);
    accuracy.flip = flip_of(of_stage, stage.result, truth);
}

}  // namespace

ImageSet run_model(const JudgedStage& stage) {
    const Technique& technique = *stage.choice.technique;
    if (!technique.model) return {};
    return technique.model({stage.frame, stage.before, stage.fragments}, stage.choice.settings);
}

Accuracy judge_stage(const JudgedStage& stage) {
    Accuracy accuracy;
    const Technique& technique = *stage.choice.technique;
    if (const auto feature = unsupported(technique, stage.features)) {
        accuracy.not_supported = fmt::format("{} ({})", name(*feature), stage.features.reason(*feature));
        return accuracy;
    }
    if (stage.against != Against::truth) judge_by_model(stage, accuracy);
    if (stage.against != Against::model && !stage.stop.stop_requested()) judge_by_truth(stage, accuracy);
    return accuracy;
}

}  // namespace strata
