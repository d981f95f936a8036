// A comparison as JSON, for CI. What is no number in JSON (NaN, infinities) is a string.
#include <cmath>

#include <nlohmann/json.hpp>

#include "replay/difference/comparison.h"
#include "replay/json_text.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
    if (std::isfinite(value)) return value;
    return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

ordered_json json_of(const Flip& flip, const FlipOptions& options) {
    ordered_json json{
        {"mean", flip.mean},
        {"weighted", {{"first_quartile", flip.first_quartile}, {"median", flip.median}, {"third_quartile", flip.third_quartile}}},
        {"low", flip.low},
        {"high", flip.high},
        {"pixels_per_degree", options.pixels_per_degree}};
    if (flip.exposures.count > 0)
        json["exposures"] = {{"start", flip.exposures.start},
                             {"stop", flip.exposures.stop},
                             {"count", flip.exposures.count},
                             {"tone_mapper", name(options.tone_mapper)}};
    return json;
}

ordered_json json_of(const ImageError& error) {
    const WorstPixel& worst = error.worst_pixel;
    return {{"rmse", error.rmse},
            {"relative_rmse", error.relative_rmse},
            {"worst", number(error.worst)},
            {"worst_unit", error.kind == ImageError::Kind::depth ? "ulps" : "value"},
            {"worst_pixel",
             {{"x", worst.x},
              {"y", worst.y},
              {"layer", worst.layer},
              {"channel", worst.channel},
              {"a", number(worst.a)},
              {"b", number(worst.b)}}},
            {"pixels", error.pixels},
            {"pixels_over_limit", error.over_limit},
            {"pixels_over_warn_limit", error.over_warn_limit},
            {"nan", {{"a", error.in_a.nan}, {"b", error.in_b.nan}}},
            {"inf", {{"a", error.in_a.inf}, {"b", error.in_b.inf}}},
            {"not_finite_in_one_alone", error.disagreeing}};
}

ordered_json json_of(const ImageComparison& image, const FlipOptions& flip) {
    ordered_json json{{"image", image.image}, {"verdict", name(image.verdict)}, {"identical", image.error.identical}};
    if (!image.reason.empty()) json["reason"] = image.reason;
    for (const Judged& judged : image.judged)
        json["comparisons"].push_back(
            {{"metric", judged.metric}, {"value", number(judged.value)}, {"threshold", number(judged.threshold)}});
    if (image.error.pixels > 0) json["error"] = json_of(image.error);
    if (image.flip) json["flip"] = json_of(*image.flip, flip);
    return json;
}

ordered_json json_of(const FrameComparison& frame, const FlipOptions& flip) {
    ordered_json json{{"frame", frame.frame}, {"verdict", name(frame.verdict)}, {"acts", ordered_json::array()}};
    for (const ActComparison& act : frame.acts) {
        ordered_json row{{"act", act.label}};
        if (!act.choice_a.empty() || !act.choice_b.empty()) row["choice"] = {{"a", act.choice_a}, {"b", act.choice_b}};
        for (const ImageComparison& image : act.images) row["images"].push_back(json_of(image, flip));
        json["acts"].push_back(row);
    }
    if (!frame.divergence.act.empty())
        json["first_difference"] = {
            {"act", frame.divergence.act}, {"image", frame.divergence.image}, {"step", frame.divergence.step}};
    return json;
}

ordered_json json_of(const Side& side) {
    ordered_json json{{"name", side.name}};
    if (!side.capture.empty()) json["capture"] = side.capture;
    if (!side.device.empty()) json["device"] = {{"name", side.device}, {"driver", side.driver}, {"cpu", side.cpu}};
    return json;
}

ordered_json json_of(const ErrorLimits& limits) {
    ordered_json json{{"limit", limits.limit.value_or(0)}, {"percent", limits.percent}, {"ulps", limits.ulps}};
    if (limits.hard_limit < ErrorLimits::none) json["hard_limit"] = limits.hard_limit;
    if (limits.warn_limit < ErrorLimits::none) json["warn"] = {{"limit", limits.warn_limit}, {"percent", limits.warn_percent}};
    if (limits.flip_mean) json["flip_mean"] = *limits.flip_mean;
    return json;
}

}  // namespace

std::string as_json(const Comparison& comparison) {
    ordered_json json{{"schema", "strata.diff"},
                      {"schema_version", 1},
                      {"tool", comparison.tool},
                      {"a", json_of(comparison.a)},
                      {"b", json_of(comparison.b)},
                      {"reference", "a"},
                      {"limits", json_of(comparison.limits)},
                      {"verdict", name(verdict(comparison))},
                      {"rerun", comparison.rerun},
                      {"frames", ordered_json::array()}};
    for (const FrameComparison& frame : comparison.frames) json["frames"].push_back(json_of(frame, comparison.limits.flip));
    return json_text(json);
}

}  // namespace strata
