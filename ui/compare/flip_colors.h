// FLIP's map in FLIP's own colors, those of its papers and of `strata diff`, times a gain so that close pictures show where they
// differ.
#pragma once

#include <memory>

#include "replay/images/image_io.h"
#include "ui/replayer/work_queue.h"
#include "ui/window/imgui_layer.h"

namespace strata::ui {

/// Black at 0, brightest at `end` and above.
Texels flip_colors(const HostImage& map, double end);

class FlipColors {
public:
    /// Once per frame: what is wanted now. The same map and end cost nothing; until they are ready the last stays.
    void show(const std::shared_ptr<const HostImage>& map, double end, WorkQueue&, ImguiLayer&);
    TextureId texture() const { return texture_; }
    bool is_busy() const { return job_ && !job_->result(); }
    /// A strip of all colors.
    TextureId legend(ImguiLayer&);

private:
    std::shared_ptr<const HostImage> wanted_;
    double end_ = 0;
    JobOf<Texels> job_;
    TextureId texture_ = 0, legend_ = 0;
};

}  // namespace strata::ui
