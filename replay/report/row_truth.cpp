#include "replay/report/row_truth.h"

#include <algorithm>

#include "capture_format/frame/frame.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/plural.h"
#include "replay/session/light_unit.h"
#include "replay/session/stand_in.h"
#include "replay/tables/table.h"

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

Result<Accuracy> measure_stage(Session& session, const Variant& variant, Stage stage, const RowTruth& row_truth) {
    if (row_truth.model_divisor == 1) return session.judge(variant.request, stage, Against::model_and_truth, &row_truth.truth);
    auto accuracy = session.judge(variant.request, stage, Against::truth, &row_truth.truth);
    if (!accuracy || !accuracy->not_supported.empty()) return accuracy;
    Request reduced = variant.request;
    reduced.variant.extent_divisor = row_truth.model_divisor;
    const auto model = session.judge(reduced, stage, Against::model);
    if (!model) return model.error();
    accuracy->model_rmse = model->model_rmse;
    accuracy->model_worst = model->model_worst;
    accuracy->compared = model->compared;
    accuracy->undecided = model->undecided;
    accuracy->trivial = model->trivial;
    accuracy->worst = model->worst;
    if (accuracy->incomparable.empty()) accuracy->incomparable = model->incomparable;
    return accuracy;
}

/// Of the image that is judged.
void add_own_error(RowTruth& row_truth, const StageInfo& stage) {
    const auto judged = row_truth.truth.find(stage.outputs.front());
    if (judged == row_truth.truth.end()) return;
    row_truth.own_error = standard_error(judged->second);
    if (!row_truth.own_error) return;
    row_truth.name += fmt::format("; its own standard error: rmse {}, relative rmse {}", short_number(row_truth.own_error->rmse),
                                  short_number(row_truth.own_error->relative));
}

/// `asks`: of which that truth is the session's answer.
Result<RowTruth> find_row_truth(Session& session, const ReportRequest& wanted, const Request& asks, const TruthRow& of,
                                const View& view) {
    RowTruth row_truth{.of = of, .name = std::string(of.is), .model_divisor = affordable_divisor(view)};
    if (row_truth.model_divisor == 1) {
        auto truth = session.truth(asks, wanted.stage);
        if (!truth) return truth.error();
        row_truth.truth = *std::move(truth);
        add_own_error(row_truth, info(wanted.stage));
        return row_truth;
    }
    for (const Technique* technique : techniques_of(wanted.stage)) {
        if (!technique->abilities.stands_in_for_truth) continue;
        Request request = asks;
        request.choices.use(*technique);
        Request reduced = request;
        reduced.variant.extent_divisor = row_truth.model_divisor;
        const auto accuracy = session.judge(reduced, wanted.stage, Against::model);
        if (!accuracy) return accuracy.error();
        if (!accuracy->not_supported.empty() || accuracy->model_rmse > stand_in_tolerance) continue;
        const auto run = session.run(request);
        if (!run) return run.error();
        if (!notes_no_limitation(*run, *technique)) continue;
        auto images = session.stage_images(request, wanted.stage);
        if (!images) return images.error();
        row_truth.truth = *std::move(images);
        row_truth.name = fmt::format("{} stands in (relative rmse {:.1e} against the truth at 1/{} extent)", technique->name,
                                     accuracy->model_rmse, row_truth.model_divisor);
        return row_truth;
    }
    return fail(Fault::usage, "report.truth_too_large",
                "{width} x {height} pixels x {samples} samples are too many for the truth of {stage} in double, and no technique "
                "can stand in; record a smaller frame",
                view.width, view.height, view.samples, name(wanted.stage));
}

/// The default of --error-at: a stage without radiance is judged by what its errors do to the picture.
ErrorAt default_error_at(Stage stage) { return makes_light(stage) ? ErrorAt::stage : ErrorAt::picture; }

/// The pictures of all truths.
Result<void> add_pictures_of(Session& session, const ReportRequest& wanted, RowTruths& found) {
    for (RowTruth& row_truth : found.all) {
        auto picture = picture_truth(session, wanted.base, wanted.stage, row_truth.truth);
        if (!picture) return picture.error();
        row_truth.picture = *std::move(picture);
    }
    return {};
}

}  // namespace

Result<TruthRow> truth_asked_by(const Request& request, Stage stage, const Frame& frame) {
    const auto choices = choose(frame, request.choices);
    if (!choices) return choices.error();
    const Choice& choice = choices->at(stage);
    return truth_of(*choice.technique, choice.settings);
}

Result<RowTruths> find_row_truths(Session& session, const ReportRequest& wanted, std::span<const Variant> rows,
                                  const Frame& frame) {
    const auto of_base = truth_asked_by(wanted.base, wanted.stage, frame);
    if (!of_base) return of_base.error();
    View view = frame.view;
    if (wanted.base.variant.samples) view.samples = wanted.base.variant.samples;
    RowTruths found;
    for (const Variant& row : rows) {
        const auto of = truth_asked_by(row.request, wanted.stage, frame);
        if (!of) return of.error();
        const auto known = std::ranges::find(found.all, of->name, [](const RowTruth& each) { return each.of.name; });
        found.of_row.push_back(std::size_t(known - found.all.begin()));
        if (known != found.all.end()) continue;
        // The base where it will do: a row may be of a technique that cannot do the frame.
        const Request& asks = of->name == of_base->name ? wanted.base : row.request;
        auto row_truth = find_row_truth(session, wanted, asks, *of, view);
        if (!row_truth) return row_truth.error();
        found.all.push_back(*std::move(row_truth));
    }
    found.error_at = wanted.error_at.value_or(default_error_at(wanted.stage));
    if (found.error_at == ErrorAt::stage) return found;
    if (const auto added = add_pictures_of(session, wanted, found); !added) {
        if (wanted.error_at || added.error().fault != Fault::usage) return added.error();
        for (RowTruth& row_truth : found.all) row_truth.picture.reset();
        found.error_at = ErrorAt::stage;
        found.no_picture = added.error().sentence;
    }
    return found;
}

Result<Accuracy> measure_accuracy(Session& session, const Variant& variant, Stage stage, const RowTruth& row_truth) {
    auto accuracy = measure_stage(session, variant, stage, row_truth);
    if (!accuracy || !accuracy->not_supported.empty() || !row_truth.picture) return accuracy;
    const auto judged = judge_picture(session, variant.request, *row_truth.picture, *accuracy);
    return judged ? std::move(accuracy) : Result<Accuracy>(judged.error());
}

}  // namespace strata
