// A stage's result against its technique's model and the stage's truth. No device.
#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "passes/blend_rounding.h"
#include "replay/session/session.h"

namespace strata {

struct DisplayError;

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

bool same_extent(const ReferenceImage&, const ReferenceImage&);

/// Leaves out the texels whose color is that of an image of the same extent before (black, if null). The share of all texels
/// that differ, undecided ones among them; nothing where no decided one does.
std::optional<double> keep_touched(ReferenceImage&, const ReferenceImage* before);

/// The figures that display light gives; those of energy are 0.
Footing footing_of(const DisplayError&);

/// Multiplies what is radiance: metrics and the worst texel.
void scale_light(Accuracy&, double factor);
/// Leaves out the texels of which a color channel is NaN in both images: that is no agreement. Their number.
std::size_t leave_out_not_numbers(const ReferenceImage& got, ReferenceImage& wanted);
/// Why nothing can be judged, where so many are all texels; `of` names them, "sample".
std::string nothing_but_not_numbers(std::size_t count, std::string_view of);
/// Share of the texels that are undecided.
double undecided_share(const ReferenceImage&);

/// The technique's model on the stage's inputs, in double.
ImageSet run_model(const JudgedStage&);

}  // namespace strata
