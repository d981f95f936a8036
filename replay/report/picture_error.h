// Errors of the picture: what the later stages make of a technique's outputs, against what they make of the stage's truth.
#pragma once

#include <vector>

#include "replay/session/session.h"

namespace strata {

/// What every row of a report is compared with.
struct PictureTruth {
    ReferenceImage display;  ///< of the truth; where its alternatives show something else, that is an alternative
    ReferenceImage touched;  ///< the same with only those pixels that the stage's choice can change
    double touched_share = 1;
};

/// The image that a display shows.
inline constexpr const char* picture_image = "display";

/// Whether the picture is one of the stage's own outputs.
bool makes_picture(Stage);
/// Whether errors of the stage's first output are errors of light: of radiance or of the picture.
bool makes_light(Stage);

/// Runs the request from the stage's truth, and from others that tell what it can change. Fails where the truth cannot take the
/// place of the stage's outputs (Session::run_from), and for a stage that makes the picture itself.
Result<PictureTruth> picture_truth(Session&, const Request&, Stage, const ImageSet& truth);

/// Runs the request and puts the errors of its picture in the place of those of the stage: Accuracy::technique_errors, flip and
/// touched. The stage's own go to Accuracy::stage_errors.
Result<void> judge_picture(Session&, Request, const PictureTruth&, Accuracy&);

}  // namespace strata
