// How the consumer records itself: the one file of it that knows Strata.
#pragma once

#include <vector>

#include <strata/recorder.h>
#include "consumer/crowd.h"

namespace consumer {

class Recording {
public:
    /// Hands over what stays: shapes, paints, the screen.
    Recording(strata::Recorder, const Crowd&);
    /// One frame: what has changed, and where everything is.
    strata::Result<void> frame(const Crowd&, const std::vector<Placement>&, std::uint64_t index,
                               const std::vector<std::uint32_t>& screen);
    strata::Recorder& recorder() { return recorder_; }

private:
    strata::Recorder recorder_;
    std::vector<strata::Draw> draws_;
};

strata::Texture texture_of(const std::vector<std::uint32_t>& screen);
strata::Material material_of(std::size_t paint, double time);
glm::dmat4 matrix_of(const Placement&);

}  // namespace consumer
