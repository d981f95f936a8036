// strata import: a glTF scene becomes a capture, of one frame or of an animation's.
#include <memory>

#include <CLI/CLI.hpp>

#include "capture_format/import/gltf.h"
#include "capture_format/recorder.h"
#include "capture_format/whole_file.h"
#include "replay/cli/verb_options.h"
#include "replay/counted.h"

namespace strata {
namespace {

struct Options {
    std::filesystem::path scene, output;
    std::string size = "640x360";
    std::uint32_t frames = 1;
    GltfOptions gltf;
    DeviceChoice device;
};

void print_imported(const Frame& frame, std::uint32_t frames, const std::filesystem::path& output) {
    fmt::print(stderr, "imported {}, {}, {}, {}, {} into {}\n", counted(frames, "frame"), counted(frame.draws.size(), "draw"),
               counted(frame.materials.size(), "material"), counted(frame.textures.size(), "texture"),
               counted(frame.lights.size(), "light"), output.string());
}

std::filesystem::path output_of(const Options& options) {
    return options.output.empty() ? options.scene.filename().replace_extension(".strata") : options.output;
}

/// Frame after frame, so that an animation of a large scene never lies in memory as a whole.
Result<void> record_frames(GltfScene& scene, const Options& options) {
    auto frame = scene.frame(0);
    if (!frame) return frame.error();
    auto file = WholeFile::begin(output_of(options));
    if (!file) return file.error();
    auto recorder = Recorder::create(file->temporary(), "imported from " + options.scene.filename().string());
    if (!recorder) return recorder.error();
    if (const auto done = add_thumbnail(*recorder, *frame, options.device); !done) return done;
    for (std::uint32_t index = 0; index < options.frames; ++index) {
        if (index > 0) frame = scene.frame(index);
        if (!frame) return frame.error();
        if (const auto done = recorder->record(*frame); !done) return done;
    }
    if (const auto done = recorder->finish(); !done) return done;
    if (const auto done = file->commit(); !done) return done;
    print_imported(*frame, options.frames, output_of(options));
    return {};
}

Result<void> import(const Options& options) {
    const auto extent = extent_of(options.size);
    if (!extent) return extent.error();
    GltfOptions gltf = options.gltf;
    std::tie(gltf.width, gltf.height) = *extent;
    if (gltf.samples != 1 && gltf.samples != 4) return fail(Fault::usage, "--samples is 1 or 4, not {}", gltf.samples);
    auto scene = GltfScene::open(options.scene, gltf);
    if (!scene) return scene.error();
    const auto recorded = record_frames(*scene, options);
    for (const std::string& warning : scene->warnings()) fmt::print(stderr, "strata: warning: {}\n", warning);
    return recorded;
}

}  // namespace

std::function<Result<void>()> declare_import(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    app.add_option("scene", options->scene, "a .gltf or .glb file")->required();
    app.add_option("-o,--output", options->output, "capture to write; default the scene's name with .strata");
    app.add_option("--size", options->size, "WIDTHxHEIGHT, default 640x360");
    app.add_option("--samples", options->gltf.samples, "samples per pixel: 1 or 4");
    app.add_option("--camera", options->gltf.camera,
                   "index of the scene's camera; default its first, or one that frames the scene");
    app.add_option("--azimuth", options->gltf.azimuth,
                   "degrees from the front towards the right of a framing camera, default 22");
    app.add_option("--elevation", options->gltf.elevation, "degrees above the horizon of a framing camera, default 16");
    app.add_option("--frames", options->frames, "how many frames; an animation begins again after its end")
        ->check(CLI::Range(1, 100000));
    app.add_option("--fps", options->gltf.fps, "frames per second of the animation, default 30");
    app.add_option("--animation", options->gltf.animation, "name or index of the animation; default the first");
    app.add_option("--gpu", options->device.gpu, "device that makes the thumbnail");
    return [options] { return import(*options); };
}

}  // namespace strata
