#include "replay/report/report.h"

#include <algorithm>
#include <cmath>

#include "replay/counted.h"

namespace strata {
namespace {

// Samples up to which the truth and the models in double take seconds; above, an exact technique stands in.
constexpr std::uint64_t largest_truth = 640 * 360;
// How exact the stand-in must be at the extent where the truth is affordable: the root mean square of each texel's error relative
// to that texel (an exact technique's model is the truth). Relative to the whole frame's mean, one highlight of clear glass, of
// radiance 1027 in a frame of 0.3, would be all of the figure.
constexpr double stand_in_tolerance = 1e-4;

struct Variant {
    const Technique* technique = nullptr;
    Request request;
    std::string settings;
};

/// Every technique with every combination of the sweeps whose keys it has.
std::vector<Variant> variants(const ReportRequest& wanted) {
    std::vector<Variant> all;
    for (const Technique* technique : techniques_of(wanted.stage)) {
        std::vector<Variant> of_technique{{technique, wanted.base, ""}};
        of_technique[0].request.uses.push_back(std::string(technique->name));
        for (const Sweep& sweep : wanted.sweeps) {
            const auto named = [&](const Param& param) { return param.name == sweep.key; };
            if (std::ranges::none_of(technique->params, named)) continue;
            std::vector<Variant> multiplied;
            for (const Variant& variant : of_technique)
                for (const std::string& value : sweep.values) {
                    multiplied.push_back(variant);
                    multiplied.back().request.sets.push_back(fmt::format("{}:{}={}", technique->name, sweep.key, value));
                    multiplied.back().settings += fmt::format("{}{}={}", variant.settings.empty() ? "" : " ", sweep.key, value);
                }
            of_technique = std::move(multiplied);
        }
        all.insert(all.end(), of_technique.begin(), of_technique.end());
    }
    return all;
}

Result<void> check_sweeps(const ReportRequest& wanted) {
    for (const Sweep& sweep : wanted.sweeps) {
        bool known = false;
        for (const Technique* technique : techniques_of(wanted.stage))
            for (const Param& param : technique->params) known = known || param.name == sweep.key;
        if (!known) return fail(Fault::usage, "no technique of the stage {} has a parameter '{}'", name(wanted.stage), sweep.key);
    }
    return {};
}

/// What the rows are measured against, and the extent at which models are affordable.
struct Yardstick {
    ImageSet truth;
    std::string name;
    std::uint32_t model_divisor = 1;
};

std::uint32_t affordable_divisor(const View& view) {
    std::uint32_t divisor = 1;
    while (std::uint64_t(view.width / divisor) * (view.height / divisor) * view.samples > largest_truth) ++divisor;
    return divisor;
}

Result<Yardstick> find_yardstick(Session& session, const ReportRequest& wanted, const View& view) {
    Yardstick yardstick{.name = "exact, in double", .model_divisor = affordable_divisor(view)};
    if (yardstick.model_divisor == 1) {
        auto truth = session.truth(wanted.base, wanted.stage);
        if (!truth) return truth.error();
        yardstick.truth = *std::move(truth);
        return yardstick;
    }
    for (const Technique* technique : techniques_of(wanted.stage)) {
        if (!technique->stands_in_for_truth) continue;
        Request request = wanted.base;
        request.uses.push_back(std::string(technique->name));
        Request reduced = request;
        reduced.extent_divisor = yardstick.model_divisor;
        const auto accuracy = session.judge(reduced, wanted.stage);
        if (!accuracy) return accuracy.error();
        if (accuracy->method.empty() || accuracy->model_rmse > stand_in_tolerance) continue;
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
                view.width, view.height, counted(view.samples, "sample"), name(wanted.stage));
}

Result<Accuracy> measure_accuracy(Session& session, const Variant& variant, Stage stage, const Yardstick& yardstick) {
    if (yardstick.model_divisor == 1) return session.judge(variant.request, stage, Against::model_and_truth, &yardstick.truth);
    auto accuracy = session.judge(variant.request, stage, Against::truth, &yardstick.truth);
    if (!accuracy || !accuracy->not_supported.empty()) return accuracy;
    Request reduced = variant.request;
    reduced.extent_divisor = yardstick.model_divisor;
    const auto model = session.judge(reduced, stage);
    if (!model) return model.error();
    accuracy->model_rmse = model->model_rmse;
    accuracy->model_worst = model->model_worst;
    return accuracy;
}

}  // namespace

void mark_front(std::vector<Measurement>& rows) {
    const auto error = [](const Measurement& row) { return row.accuracy.method.front().value; };
    for (Measurement& row : rows) {
        row.on_front = !row.accuracy.method.empty();
        for (const Measurement& other : rows) {
            if (!row.on_front || other.accuracy.method.empty()) continue;
            const bool no_worse = error(other) <= error(row) && other.stage_ms.median <= row.stage_ms.median;
            const bool better = error(other) < error(row) || other.stage_ms.median < row.stage_ms.median;
            if (no_worse && better) row.on_front = false;
        }
    }
}

std::vector<Figure> errors_of(const Measurement& row) {
    std::vector<Figure> errors = row.accuracy.method;
    if (row.accuracy.flip) errors.push_back({"FLIP", "", *row.accuracy.flip});
    return errors;
}

Result<Report> make_report(Session& session, const ReportRequest& wanted, const Progress& progress) {
    const auto tell = [&](std::string_view what, double done) {
        if (progress) progress(what, done);
    };
    if (techniques_of(wanted.stage).empty()) return fail(Fault::usage, "the stage {} has no technique yet", name(wanted.stage));
    if (const auto fits = check_sweeps(wanted); !fits) return fits.error();
    const auto frame = session.frame(wanted.base.frame);
    if (!frame) return frame.error();
    View view = frame->view;
    if (wanted.base.samples) view.samples = wanted.base.samples;

    Report report{.stage = wanted.stage,
                  .capture_id = session.capture_id(),
                  .frame = wanted.base.frame,
                  .repeats = wanted.repeats,
                  .width = view.width,
                  .height = view.height,
                  .samples = view.samples,
                  .device = session.device()};
    const auto planned = session.plan(wanted.base);
    if (!planned) return planned.error();
    for (const SkippedStage& skipped : planned->skipped)
        if (skipped.stage == wanted.stage) {
            report.skipped = skipped.reason;
            return report;
        }

    tell("truth", 0);
    const auto yardstick = find_yardstick(session, wanted, view);
    if (!yardstick) return yardstick.error();
    report.truth = yardstick->name;

    const std::vector<Variant> all = variants(wanted);
    std::vector<Request> timed;
    for (std::size_t i = 0; i < all.size(); ++i) {
        tell(all[i].technique->name, .1 + .6 * double(i) / double(all.size()));
        auto accuracy = measure_accuracy(session, all[i], wanted.stage, *yardstick);
        if (!accuracy) return accuracy.error();
        if (accuracy->not_supported.empty()) timed.push_back(all[i].request);
        report.rows.push_back(
            {.technique = std::string(all[i].technique->name), .settings = all[i].settings, .accuracy = *std::move(accuracy)});
    }
    tell("timing", .7);
    const auto runs = session.time(timed, wanted.repeats);
    if (!runs) return runs.error();
    auto run = runs->begin();
    for (Measurement& row : report.rows) {
        if (!row.accuracy.not_supported.empty()) continue;
        const std::string stage_name(name(wanted.stage));
        row.stage_ms = run->stage_ms.at(stage_name);
        row.frame_ms = *run->frame_ms;
        if (const auto bytes = run->stage_bytes.find(stage_name); bytes != run->stage_bytes.end())
            row.stage_bytes = bytes->second;
        std::ranges::copy_if(run->counters, std::back_inserter(row.counters),
                             [&](const CounterRecord& counter) { return counter.technique == row.technique; });
        ++run;
    }
    mark_front(report.rows);
    std::ranges::stable_sort(report.rows, {}, [](const Measurement& row) {
        return row.accuracy.method.empty() ? HUGE_VAL : row.accuracy.method.front().value;
    });
    tell("done", 1);
    return report;
}

}  // namespace strata
