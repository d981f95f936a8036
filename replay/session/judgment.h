// A stage's result against its technique's model and the stage's truth. No device.
#pragma once

#include <optional>
#include <stop_token>

#include "passes/blend_rounding.h"
#include "replay/session/session.h"

namespace strata {

struct JudgedStage {
    const Frame& frame;
    const Features& features;
    const Choice& choice;
    const ImageSet& before;
    const ImageSet& result;
    Against against = Against::model_and_truth;
    const ImageSet* truth = nullptr;                    ///< null: computed here
    std::optional<FragmentLists>* fragments = nullptr;  ///< as StageInput's
    BlendRounding rounding = {};                        ///< of the device that gave the result
    std::uint32_t snap_steps = 256;                     ///< and DeviceInfo::snap_steps
    std::stop_token stop = {};                          ///< once requested, what is left is left out and the answer worth nothing
};

Accuracy judge_stage(const JudgedStage&);

/// Sides of triangles lie elsewhere on a device that snaps corners to coarser steps (DeviceInfo::snap_steps) than models and
/// truths do. There images of the frame's extent become undecided.
void leave_out_sides(const Frame&, std::uint32_t device_snap_steps, ImageSet&);

/// Leaves out the texels whose color is that of an image of the same extent before (black, if null). The share of all texels
/// that differ, undecided ones among them; nothing where no decided one does.
std::optional<double> keep_touched(ReferenceImage&, const ReferenceImage* before);

/// The technique's model on the stage's inputs, in double.
ImageSet run_model(const JudgedStage&);

}  // namespace strata
