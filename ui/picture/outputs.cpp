#include "ui/picture/outputs.h"

#include <algorithm>

#include "passes/frame_images.h"
#include "passes/technique.h"

namespace strata::ui {

std::vector<std::string> outputs_of(const Model& model) {
    std::vector<std::string> names;
    for (const FrameImageRow& row : frame_images())
        // Where an image's samples are to be had as layers, those are what can be read.
        if (!find_frame_image(fmt::format("{}_layers", row.name))) names.emplace_back(row.name);
    // What a person looks at most is last in the frame.
    std::ranges::reverse(names);
    if (model.is_known())
        for (const auto& [stage, choice] : model.choices())
            for (const DebugView& view : choice.technique->views)
                names.push_back(fmt::format("{}:{}", choice.technique->name, view.name));
    return names;
}

}  // namespace strata::ui
