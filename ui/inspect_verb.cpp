// strata inspect: the inspector in a window, or played by a script.
#include <memory>

#include <CLI/CLI.hpp>

#include "replay/cli/verb_options.h"
#include "ui/inspect.h"

namespace strata {
namespace {

struct Options {
    OpenOptions open;
    ChoiceOptions choices;
    std::size_t frame = 0;
    std::string size;
    std::filesystem::path script, shaders;
};

Result<void> inspect(const Options& options) {
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->variant.frame = options.frame;
    ui::InspectOptions inspected{.capture = options.open.capture,
                                 .device = options.open.device,
                                 .partial = options.open.allow_partial ? Partial::allowed : Partial::refused,
                                 .first = *std::move(request),
                                 .shaders = options.shaders,
                                 .script = options.script};
    if (!options.size.empty()) {
        const auto extent = extent_of(options.size);
        if (!extent) return extent.error();
        inspected.extent = *extent;
    }
    return ui::inspect(inspected);
}

}  // namespace

std::function<Result<void>()> declare_inspect(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    add_options(app, options->open);
    add_options(app, options->choices);
    app.add_option("--frame", options->frame, "index of the frame shown first, default 0");
    app.add_option("--size", options->size, "extent of the window or of a script's pictures, like 1280x800");
    app.add_option("--script", options->script, "run the commands of this file without a window (ui/README.md)")
        ->type_name(input_file);
    app.add_option("--shaders", options->shaders,
                   "replace built-in shaders by those in the passes/ folder of this folder; key R recompiles them; default: the "
                   "current folder");
    return [options] { return inspect(*options); };
}

}  // namespace strata
