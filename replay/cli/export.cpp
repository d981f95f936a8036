// strata export: one thing of a frame in a format that other programs read. One kind and one file per call.
#include <memory>

#include <CLI/CLI.hpp>

#include "replay/cli/export_kinds.h"
#include "replay/cli/given_options.h"

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
    std::string flags, given;
    for (const Kind& kind : kinds) {
        flags += fmt::format("{}{}", flags.empty() ? "" : ", ", kind.flag);
        if (!kind.wanted(options)) continue;
        given += fmt::format("{}{}", given.empty() ? "" : " and ", kind.flag);
        if (chosen) return fail(Fault::usage, "one export makes one file: {} cannot be asked for together", given);
        chosen = &kind;
    }
    if (!chosen) return fail(Fault::usage, "say what to export: one of {}", flags);
    if (!chosen->replays) {
        const auto fits = check_not_given(app, {"--use", "--set", "--force", "--samples", "--gpu", "--without", "--validation"},
                                          fmt::format("{} exports the frame as it was recorded", chosen->flag));
        if (!fits) return fits;
    }
    if (const auto done = chosen->run(options); !done) return done;
    to_stderr("wrote {}\n", options.output.string());
    return {};
}

}  // namespace

std::function<Result<void>()> declare_export(CLI::App& app) {
    const auto options = std::make_shared<ExportOptions>();
    add_options(app, options->open);
    add_options(app, options->choices);
    CLI::Option* deep = app.add_flag("--deep", options->deep, "every transparent fragment, sorted, as a deep OpenEXR image");
    app.add_option("--image", options->images, "frame images or stage/technique:view, as .exr or (one of them) .png")
        ->delimiter(',');
    app.add_flag("--gltf", options->gltf, "meshes, materials, lights and camera as a .glb");
    app.add_flag("--json", options->json, "the frame as JSON with the schema's names; bulk data by its hashes");
    app.add_option("--frame", options->frame, "which frame, default 0");
    app.add_option("--sample", options->sample, "--deep: which sample of a pixel, where there are several")->needs(deep);
    app.add_option("--transmittance", options->transmittance,
                   "--deep: colored glass is refused (the default), made grey by the mean, or kept in channels AR, AG, AB")
        ->check(CLI::IsMember({"refused", "mean", "channels"}))
        ->needs(deep);
    app.add_option("-o,--output", options->output, "file to write")->required()->type_name(output_file);
    return [options, &app] { return run(*options, app); };
}

}  // namespace strata
