// The stage film: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/film/judge.h"
#include "passes/film/truth.h"
#include "passes/stages.h"

namespace strata::film {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::grain)) return std::nullopt;
    return "the film has no grain and does not fade";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "adds grain and fading",
            .unwanted = unwanted,
            .outputs = {"display"},
            .truth = film_truth,
            .judge = film_judge,
            .scenarios = {"lamp_at_night"}};
}

}  // namespace strata::film
