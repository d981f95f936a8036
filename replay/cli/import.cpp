// strata import: a glTF scene becomes a capture, of one frame or of an animation's; so does a deep image.
#include <functional>
#include <memory>

#include <CLI/CLI.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/import/deep.h"
#include "capture_format/import/gltf.h"
#include "capture_format/recorder.h"
#include "replay/cli/given_options.h"
#include "replay/cli/verb_options.h"
#include "replay/plural.h"
#include "replay/progress_line.h"

namespace strata {
namespace {

struct ImportArguments {
    std::filesystem::path scene, output;
    std::string size = "640x360";
    std::uint32_t frames = 1;
    GltfOptions gltf;
    bool deep = false;
    DeepOptions of_deep;
    std::vector<std::int32_t> window;  ///< of a deep image: x, y, width, height
    DeviceChoice device;
};

std::filesystem::path output_of(const ImportArguments& options) {
    return options.output.empty() ? options.scene.filename().replace_extension(".strata") : options.output;
}

/// Frame after frame, so that an animation of a large scene never lies in memory as a whole. Returns the last one.
Result<Frame> record_frames(const ImportArguments& options, std::uint32_t count,
                            const std::function<Result<Frame>(std::uint32_t)>& frame_at) {
    auto frame = frame_at(0);
    if (!frame) return frame;
    auto file = WholeFile::begin(output_of(options));
    if (!file) return file.error();
    auto recorder = Recorder::create(file->temporary(), "imported from " + options.scene.filename().string());
    if (!recorder) return recorder.error();
    if (const auto done = add_thumbnail(*recorder, *frame, options.device); !done) return done.error();
    const Progress progress = progress_line();
    for (std::uint32_t index = 0; index < count; ++index) {
        show_frame(progress, index, count);
        if (index > 0) frame = frame_at(index);
        if (!frame) return frame;
        if (const auto done = recorder->record(*frame); !done) return done.error();
    }
    if (const auto done = recorder->finish(); !done) return done.error();
    if (const auto done = file->commit(); !done) return done.error();
    return frame;
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) to_stderr("strata: warning: {}\n", warning);
}

Result<void> import_deep_image(const ImportArguments& options) {
    DeepOptions of_deep = options.of_deep;
    if (!options.window.empty() && (options.window[2] < 1 || options.window[3] < 1))
        return fail(Fault::usage, "--window takes a width and a height above 0, not {} x {}", options.window[2],
                    options.window[3]);
    if (!options.window.empty())
        of_deep.window = DeepWindow{options.window[0], options.window[1], static_cast<std::uint32_t>(options.window[2]),
                                    static_cast<std::uint32_t>(options.window[3])};
    auto image = import_deep(options.scene, of_deep);
    if (!image) return image.error();
    print_warnings(image->warnings);
    const auto recorded = record_frames(options, 1, [&](std::uint32_t) { return std::move(image->frame); });
    if (!recorded) return recorded.error();
    const DeepCensus& census = image->census;
    to_stderr("imported {} of {} as {} in {}, {} in the deepest, into {}\n", plural(census.samples, "sample"),
              options.scene.filename().string(), plural(census.fragments, "fragment"), plural(census.pixels, "pixel"),
              census.deepest, output_of(options).string());
    return {};
}

Result<void> import(const ImportArguments& options, const CLI::App& app) {
    if (options.deep) {
        const auto fits = check_not_given(
            app, {"--size", "--samples", "--camera", "--azimuth", "--elevation", "--frames", "--fps", "--animation"},
            "a deep image is one frame with a view of its own");
        return fits ? import_deep_image(options) : fits;
    }
    const auto extent = extent_of(options.size);
    if (!extent) return extent.error();
    GltfOptions gltf = options.gltf;
    std::tie(gltf.width, gltf.height) = *extent;
    auto scene = GltfScene::open(options.scene, gltf);
    if (!scene) return scene.error();
    const auto last = record_frames(options, options.frames, [&](std::uint32_t index) { return scene->frame(index); });
    print_warnings(scene->warnings());
    if (!last) return last.error();
    to_stderr("imported {}, {}, {}, {}, {} into {}\n", plural(options.frames, "frame"), plural(last->draws.size(), "draw"),
              plural(last->materials.size(), "material"), plural(last->textures.size(), "texture"),
              plural(last->lights.size(), "light"), output_of(options).string());
    return {};
}

}  // namespace

std::function<Result<void>()> declare_import(CLI::App& app) {
    const auto options = std::make_shared<ImportArguments>();
    app.add_option("scene", options->scene, "a .gltf or .glb file, or with --deep a deep OpenEXR image")
        ->required()
        ->type_name(input_file);
    CLI::Option* deep =
        app.add_flag("--deep", options->deep, "the file is a deep image: its samples become transparent fragments");
    app.add_option("--part", options->of_deep.part, "part of a deep file by name or number; default its first deep one")
        ->needs(deep);
    app.add_option("--window", options->window, "X,Y,WIDTH,HEIGHT: pixels of a deep file; default its display window")
        ->delimiter(',')
        ->expected(4)
        ->needs(deep);
    app.add_option("-o,--output", options->output, "capture to write; default the scene's name with .strata")
        ->type_name(output_file);
    app.add_option("--size", options->size, "WIDTHxHEIGHT, default 640x360");
    app.add_option("--samples", options->gltf.samples, "samples per pixel")->check(CLI::IsMember({1, 4}));
    app.add_option("--camera", options->gltf.camera,
                   "index of the scene's camera; default its first, or one that frames the scene")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--azimuth", options->gltf.azimuth,
                   "degrees from the front towards the right of a framing camera, default 22");
    app.add_option("--elevation", options->gltf.elevation, "degrees above the horizon of a framing camera, default 16");
    app.add_option("--frames", options->frames, "how many frames; an animation begins again after its end")
        ->check(CLI::Range(1, 100000));
    app.add_option("--fps", options->gltf.fps, "frames per second of the animation, default 30");
    app.add_option("--animation", options->gltf.animation, "name or index of the animation; default the first");
    app.add_option("--gpu", options->device.gpu, "device that makes the thumbnail");
    return [options, &app] { return import(*options, app); };
}

}  // namespace strata
