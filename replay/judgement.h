// A stage's result against its technique's model and the stage's truth. No device.
#pragma once

#include <optional>
#include <stop_token>

#include "passes/technique.h"
#include "replay/session.h"

namespace strata {

struct JudgedStage {
    const Frame& frame;
    const Features& features;
    const Choice& choice;
    const ImageSet& before;
    const ImageSet& result;
    Against against = Against::model_and_truth;
<<<<<<< HEAD
    const ImageSet* truth = nullptr;                    ///< null: computed here
    std::optional<FragmentLists>* fragments = nullptr;  ///< as StageInput's
=======
    const ImageSet* truth = nullptr;  ///< null: computed here
    /// Where the frame's transparent fragments before the stage are kept from one judgement to the next; null: nowhere.
    std::optional<FragmentLists>* fragments = nullptr;
    std::stop_token stop = {};  ///< once requested, what is left is left out and the answer worth nothing
>>>>>>> reload
};

Accuracy judge_stage(const JudgedStage&);

/// The technique's model on the stage's inputs, in double.
ImageSet run_model(const JudgedStage&);

}  // namespace strata
