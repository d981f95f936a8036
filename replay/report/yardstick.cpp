#include "replay/report/yardstick.h"

#include "replay/plural.h"

namespace strata {
namespace {

// Samples up to which the truth and the models in double take seconds; above, an exact technique stands in.
constexpr std::uint64_t largest_truth = 640 * 360;
// How exact the stand-in must be at the extent where the truth is affordable: the root mean square of each texel's error relative
// to that texel (an exact technique's model is the truth). Relative to the whole frame's mean, one highlight of clear glass, of
// radiance 1027 in a frame of 0.3, would be all of the figure.
constexpr double stand_in_tolerance = 1e-4;

std::uint32_t affordable_divisor(const View& view) {
    std::uint32_t divisor = 1;
    while (std::uint64_t(view.width / divisor) * (view.height / divisor) * view.samples > largest_truth) ++divisor;
    return divisor;
}

Result<Accuracy> measure_stage(Session& session, const Variant& variant, Stage stage, const Yardstick& yardstick) {
    if (yardstick.model_divisor == 1) return session.judge(variant.request, stage, Against::model_and_truth, &yardstick.truth);
    auto accuracy = session.judge(variant.request, stage, Against::truth, &yardstick.truth);
    if (!accuracy || !accuracy->not_supported.empty()) return accuracy;
    Request reduced = variant.request;
    reduced.variant.extent_divisor = yardstick.model_divisor;
    const auto model = session.judge(reduced, stage, Against::model);
    if (!model) return model.error();
    accuracy->model_rmse = model->model_rmse;
    accuracy->model_worst = model->model_worst;
    if (accuracy->incomparable.empty()) accuracy->incomparable = model->incomparable;
    return accuracy;
}

}  // namespace

Result<Yardstick> find_yardstick(Session& session, const ReportRequest& wanted, const View& view) {
    Yardstick yardstick{.name = std::string(info(wanted.stage).truth_is), .model_divisor = affordable_divisor(view)};
    if (yardstick.model_divisor == 1) {
        auto truth = session.truth(wanted.base, wanted.stage);
        if (!truth) return truth.error();
        yardstick.truth = *std::move(truth);
        return yardstick;
    }
    for (const Technique* technique : techniques_of(wanted.stage)) {
        if (!technique->abilities.stands_in_for_truth) continue;
        Request request = wanted.base;
        request.choices.use(*technique);
        Request reduced = request;
        reduced.variant.extent_divisor = yardstick.model_divisor;
        const auto accuracy = session.judge(reduced, wanted.stage, Against::model);
        if (!accuracy) return accuracy.error();
        if (!accuracy->not_supported.empty() || accuracy->model_rmse > stand_in_tolerance) continue;
        request.outputs.assign(info(wanted.stage).outputs.begin(), info(wanted.stage).outputs.end());
        const auto run = session.run(request);
        if (!run) return run.error();
        for (const auto& [name, image] : run->images) yardstick.truth.emplace(name, in_double(image));
        yardstick.name = fmt::format("{} stands in (relative rmse {:.1e} against the truth at 1/{} extent)", technique->name,
                                     accuracy->model_rmse, yardstick.model_divisor);
        return yardstick;
    }
    return fail(Fault::usage,
                "{} x {} at {} per pixel is too large for the truth of {} in double, and no technique can stand in; record a "
                "smaller frame",
                view.width, view.height, plural(view.samples, "sample"), name(wanted.stage));
}

Result<Accuracy> measure_accuracy(Session& session, const Variant& variant, Stage stage, const Yardstick& yardstick) {
    auto accuracy = measure_stage(session, variant, stage, yardstick);
    if (!accuracy || !accuracy->not_supported.empty() || !yardstick.picture) return accuracy;
    const auto judged = judge_picture(session, variant.request, *yardstick.picture, *accuracy);
    return judged ? std::move(accuracy) : Result<Accuracy>(judged.error());
}

}  // namespace strata
