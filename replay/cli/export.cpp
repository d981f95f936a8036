// strata export: one thing of a frame in a format that other programs read. One kind and one file per call.
#include <memory>

#include <CLI/CLI.hpp>

#include "passes/frame_images.h"
#include "replay/cli/export_kinds.h"
#include "replay/cli/given_options.h"
#include "replay/progress_line.h"

namespace strata {
namespace {

struct Kind {
    std::string_view flag;
    bool (*wanted)(const ExportOptions&);
    Result<void> (*run)(const ExportOptions&);
    bool replays;  ///< else it takes the frame as it was recorded
};

constexpr Kind kinds[] = {
    {"--deep", [](const ExportOptions& options) { return options.deep; }, export_deep, true},
    {"--image", [](const ExportOptions& options) { return !options.images.empty(); }, export_images, true},
    {"--gltf", [](const ExportOptions& options) { return options.gltf; }, export_scene, false},
    {"--json", [](const ExportOptions& options) { return options.json; }, export_json, false},
};

Result<void> run(const ExportOptions& options, const CLI::App& app) {
    const Kind* chosen = nullptr;
    std::string flags;
    for (const Kind& kind : kinds) {
        flags += fmt::format("{}{}", flags.empty() ? "" : ", ", kind.flag);
        if (!kind.wanted(options)) continue;
        if (chosen)
            return fail(Fault::usage, "options.excluded", "{option} cannot be combined with {other}: an export is one file",
                        chosen->flag, kind.flag);
        chosen = &kind;
    }
    if (!chosen) return fail(Fault::usage, "options.missing", "choose what to export with one of {option}", flags);
    if (!chosen->replays) {
        const auto fits = check_not_given(app, {"--use", "--set", "--force", "--samples", "--gpu", "--without", "--validation"},
                                          fmt::format("{} exports the frame as it was recorded", chosen->flag));
        if (!fits) return fits;
    }
    const Progress progress = progress_line();
    progress("exporting", 0);
    if (const auto done = chosen->run(options); !done) return done;
    to_stderr("wrote {}\n", options.output.string());
    return {};
}

}  // namespace

std::function<Result<void>()> declare_export(CLI::App& app) {
    const auto options = std::make_shared<ExportOptions>();
    add_options(app, options->open);
    add_options(app, options->choices);
    CLI::Option* deep =
        app.add_flag("--deep", options->deep, "write every transparent fragment, sorted by depth, as a deep OpenEXR image");
    CLI::Option* image =
        app.add_option("--image", options->images,
                       "write frame images or views (stage/technique:view) as .exr, or a single one as .png, one pixel per texel")
            ->delimiter(',');
    app.add_flag("--caption", options->caption, "enlarge a .png and add a title, a scale and what the image shows")->needs(image);
    app.add_flag("--gltf", options->gltf, "write meshes, materials, lights and camera as a .glb");
    app.add_flag("--json", options->json, "write the frame as JSON with the schema's field names; bulk data appears as hashes");
    app.add_option("--frame", options->frame, "index of the frame, default 0");
    app.add_option("--sample", options->sample,
                   "index of the sample to write with --deep, in a frame with several samples per pixel")
        ->check(sample_index())
        ->needs(deep);
    app.add_option("--transmittance", options->transmittance,
                   "how --deep treats colored transmittance: refuse it (default), write its mean, or write channels AR, AG, AB")
        ->check(one_of({"refused", "mean", "channels"}))
        ->needs(deep);
    app.add_option("-o,--output", options->output, "file to write")->required()->type_name(output_file);
    return [options, &app] { return run(*options, app); };
}

}  // namespace strata
