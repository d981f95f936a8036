#include "replay/cli/output_picture.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "passes/view_params.h"
#include "replay/difference/picture.h"
#include "replay/images/image_io.h"
#include "replay/standard_streams.h"

namespace strata {
namespace {

/// What the channels mean, where they are not colors.
std::vector<Swatch> channel_swatches(const std::array<std::string_view, 3>& meanings) {
    constexpr std::array<std::string_view, 3> names = {"red", "green", "blue"};
    constexpr std::array<Rgb, 3> colors = {Rgb(255, 0, 0), Rgb(0, 255, 0), Rgb(0, 0, 255)};
    std::vector<Swatch> swatches;
    for (std::size_t i = 0; i < meanings.size(); ++i)
        if (!meanings[i].empty() && meanings[i] != names[i]) swatches.push_back({colors[i], std::string(meanings[i])});
    return swatches;
}

ImageLegend legend_of(const DebugView& view) {
    const bool is_light = content_of(view) == Content::radiance;
    ImageLegend legend{.low = is_light ? std::optional<double>() : view.low,
                       .unit = std::string(view.unit),
                       .channels = is_light ? std::vector<Swatch>() : channel_swatches(view.channels),
                       .if_zero = std::string(view.if_zero),
                       .help = std::string(view.help)};
    if (view.low == -view.high) legend.middle = 0;
    if (view.unit == "x") legend.middle = 1;  // a factor
    for (const ViewColor& color : view.colors) legend.colors.push_back({Rgb(color.color * 255.f + .5f), color.meaning});
    return legend;
}

/// The debug view "stage/technique:name", or null.
const DebugView* find_shown_view(std::string_view image) {
    const std::size_t colon = image.find(':');
    const auto technique = colon == image.npos ? Result<const Technique*>(nullptr) : find_technique(image.substr(0, colon));
    if (!technique || !*technique) return nullptr;
    const auto view = std::ranges::find((*technique)->views, image.substr(colon + 1), &DebugView::name);
    return view == (*technique)->views.end() ? nullptr : &*view;
}

/// Of an image of the frame, or of a debug view.
ImageLegend legend_of(std::string_view image) {
    if (const FrameImageRow* row = find_frame_image(image))
        return {.low = {},
                .unit = row->content == Content::radiance ? "W/(m^2 sr)" : "",
                .channels = channel_swatches(row->channels),
                .help = std::string(row->help)};
    const DebugView* view = find_shown_view(image);
    return view ? legend_of(*view) : ImageLegend{};
}

/// Without the parameters that have their defaults and that the view, if there is one, does not name.
std::string without_defaults(const std::string& choice, const DebugView* view) {
    std::istringstream words(choice);
    std::string text, word;
    words >> text;
    const auto technique = find_technique(text);
    const std::vector<std::string> defaults = technique ? Settings((*technique)->params).lines() : std::vector<std::string>();
    while (words >> word)
        if (std::ranges::count(defaults, word) == 0 || (view && names_param(*view, word.substr(0, word.find('=')))))
            text += " " + word;
    return text;
}

/// The choice of the last stage that writes the image.
std::string choice_of(const Run& run, std::string_view image) {
    const DebugView* view = find_shown_view(image);
    std::string last;
    for (const StageInfo& stage : stages()) {
        const auto choice = run.choices.find(std::string(stage.name));
        const bool is_its = image.starts_with(std::string(stage.name) + "/") || std::ranges::count(stage.outputs, image) > 0;
        if (is_its && choice != run.choices.end()) last = without_defaults(choice->second, view);
    }
    return last;
}

}  // namespace

std::string without_defaults(const std::string& choice) { return without_defaults(choice, nullptr); }

Result<void> write_output_picture(const std::filesystem::path& path, const Run& run, const std::string& image,
                                  const std::string& of) {
    const HostImage& shown = run.images.at(image);
    const FrameImageRow* row = find_frame_image(image);
    if (row && row->content == Content::display) return write_png(path, shown);
    const std::string title = fmt::format("{}  {}", of, choice_of(run, image));
    return write_png(path, image_picture(image, shown, title, legend_of(image)));
}

Result<void> write_plain_picture(const std::filesystem::path& path, const Run& run, const std::string& image) {
    const HostImage& shown = run.images.at(image);
    const FrameImageRow* row = find_frame_image(image);
    if (row && row->content == Content::display) return write_png(path, shown);
    const PlainPicture picture = plain_picture(image, shown, legend_of(image));
    if (!picture.scale.empty()) to_stderr("strata: in {} {}; an .exr has the values\n", path.string(), picture.scale);
    return write_png(path, picture.canvas);
}

}  // namespace strata
