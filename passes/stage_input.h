// What models and truths of a stage start from.
#pragma once

#include <optional>

#include "passes/blend_rounding.h"
#include "passes/image_set.h"
#include "passes/reference/image.h"

namespace strata {

class FragmentLists;  // passes/reference/fragments.h
struct Frame;         // capture_format/frame.h

/// What a model or a truth starts from: the recorded frame and the images as they were before the stage ran.
struct StageInput {
    const Frame& frame;
    const ImageSet& before;
    /// Where the frame's transparent fragments before the stage are kept from one model to the next, made when the first wants
    /// them; null: nowhere.
    std::optional<FragmentLists>* fragments = nullptr;
    BlendRounding rounding = {};  ///< of the device that a model is compared with; truths do not read it
};

}  // namespace strata
