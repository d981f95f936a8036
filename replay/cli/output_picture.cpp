#include "replay/cli/output_picture.h"

#include <algorithm>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "replay/difference/picture.h"
#include "replay/images/image_io.h"

namespace strata {
namespace {

/// Of a debug view "stage/technique:name"; an image of the frame has none.
std::optional<ViewScale> scale_of(std::string_view image) {
    const std::size_t colon = image.find(':');
    const auto technique = colon == image.npos ? Result<const Technique*>(nullptr) : find_technique(image.substr(0, colon));
    if (!technique || !*technique) return {};
    const auto view = std::ranges::find((*technique)->views, image.substr(colon + 1), &DebugView::name);
    if (view == (*technique)->views.end()) return {};
    return ViewScale{view->low, view->high, std::string(view->unit)};
}

/// The choice of the last stage that writes the image.
std::string choice_of(const Run& run, std::string_view image) {
    std::string last;
    for (const StageInfo& stage : stages()) {
        const auto choice = run.choices.find(std::string(stage.name));
        const bool is_its = image.starts_with(std::string(stage.name) + "/") || std::ranges::count(stage.outputs, image) > 0;
        if (is_its && choice != run.choices.end()) last = choice->second;
    }
    return last;
}

}  // namespace

Result<void> write_output_picture(const std::filesystem::path& path, const Run& run, const std::string& image,
                                  const std::string& of) {
    const HostImage& shown = run.images.at(image);
    const FrameImageRow* row = find_frame_image(image);
    if (row && row->content == Content::display) return write_png(path, shown);
    const std::string title = fmt::format("{}  {}", of, choice_of(run, image));
    return write_png(path, image_picture(image, shown, title, scale_of(image)));
}

}  // namespace strata
