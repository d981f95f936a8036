// strata export --image: what a stage gave, or a debug view.
#include <algorithm>
#include <cstring>

#include "passes/registry.h"
#include "replay/cli/export_kinds.h"
#include "replay/cli/run_json.h"

namespace strata {
namespace {

/// Values that a picture shows as black and white: a view's own, 0 and 1 for the frame's images.
std::pair<double, double> range_of(std::string_view image) {
    const std::size_t colon = image.find(':');
    if (colon == image.npos) return {0, 1};
    const auto technique = find_technique(image.substr(0, colon));
    if (!technique) return {0, 1};
    const auto view = std::ranges::find((*technique)->views, image.substr(colon + 1), &DebugView::name);
    return view == (*technique)->views.end() ? std::pair(0.0, 1.0) : std::pair(view->low, view->high);
}

/// As display light: one channel is grey, two are red and green.
HostImage as_picture(const HostImage& image, std::string_view name) {
    const auto [low, high] = range_of(name);
    const std::uint32_t channels = row(image.shape.format).channels;
    HostImage picture{{.extent = image.shape.extent, .format = Format::rgba32f}, {}};
    for (std::uint32_t y = 0; y < image.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < image.shape.extent.width; ++x) {
            glm::dvec4 value = texel(image, x, y);
            if (channels == 1) value = glm::dvec4(glm::dvec3(value.x), 1);
            const glm::vec4 shown((value - low) / (high - low));
            const auto* bytes = reinterpret_cast<const std::byte*>(&shown);
            picture.texels.insert(picture.texels.end(), bytes, bytes + sizeof shown);
        }
    return picture;
}

Result<void> write_picture(const ExportOptions& options, const Run& run) {
    if (run.images.size() != 1)
        return fail(Fault::usage, "a .png holds one image, not {}; an .exr holds them all", run.images.size());
    const auto& [name, image] = *run.images.begin();
    if (image.shape.layers > 1)
        return fail(Fault::usage,
                    "'{}' has {} layers and a .png one; an .exr holds them all, and --samples 1 makes one of samples", name,
                    image.shape.layers);
    return write_png(options.output, as_picture(image, name));
}

}  // namespace

Result<void> export_images(const ExportOptions& options) {
    const std::string kind = options.output.extension().string();
    if (kind != ".exr" && kind != ".png")
        return fail(Fault::usage, "images are written as .exr or .png, not as '{}'", options.output.filename().string());
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->variant.frame = options.frame;
    request->outputs = options.images;
    auto session = open(options.open);
    if (!session) return session.error();
    const auto run = (*session)->run(*request);
    if (!run) return run.error();
    for (const std::string& name : options.images)
        if (!run->images.contains(name)) return fail(Fault::usage, "the frame has no '{}': its stage is left out", name);
    if (kind == ".png") return write_picture(options, *run);
    return write_exr(options.output, run->images, provenance(**session, *request, *run));
}

}  // namespace strata
