// strata import: a glTF scene becomes a capture, of one frame or of an animation's; so does a deep image.
#include <array>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>

#include <CLI/CLI.hpp>

#include "capture_format/container/picture.h"
#include "capture_format/container/whole_file.h"
#include "capture_format/import/deep.h"
#include "capture_format/import/gltf.h"
#include "capture_format/import/seen.h"
#include "capture_format/recorder.h"
#include "passes/tone_curve.h"
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
    std::vector<double> eye, target;  ///< x, y, z or nothing
    bool deep = false;
    DeepOptions of_deep;
    std::uint64_t memory_budget = 0;
    std::vector<std::int32_t> window;  ///< of a deep image: x, y, width, height
    DeviceChoice device;
};

std::filesystem::path output_of(const ImportArguments& options) {
    return options.output.empty() ? options.scene.filename().replace_extension(".strata") : options.output;
}

/// What an imported frame holds.
struct Counts {
    std::size_t draws = 0, materials = 0, textures = 0, lights = 0;
};

/// Room for a frame, however large it is.
RecorderOptions room_for(const Frame& frame) {
    RecorderOptions options;
    options.budget_bytes = std::max(options.budget_bytes, recorded_bytes(frame));
    return options;
}

/// A black picture is the most frequent disappointment of an import: no light, a camera in a closed box, mirrors of nothing.
void warn_of_darkness(const Texture& picture) {
    constexpr auto black = std::byte{2};  // of 255, in sRGB
    constexpr double most = 0.8;          // of the picture
    std::size_t dark = 0;
    const std::size_t pixels = picture.texels.size() / 4;
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::byte* texel = &picture.texels[4 * i];
        dark += std::max({texel[0], texel[1], texel[2]}) <= black ? 1 : 0;
    }
    const double share = double(dark) / double(pixels);
    if (share > most)
        to_stderr(
            "strata: warning: {:.0f} % of the picture is black; move the camera with --eye and --target, or with --inside\n",
            100 * share);
}

/// The capture that an import writes, whole or not at all.
struct CaptureBeingWritten {
    WholeFile file;
    Recorder recorder;

    Result<void> finish() {
        const auto finished = recorder.finish();
        return finished ? file.commit() : finished;
    }
};

Result<CaptureBeingWritten> begin_capture(const ImportArguments& options, const RecorderOptions& recording) {
    auto file = WholeFile::begin(output_of(options));
    if (!file) return file.error();
    auto recorder = file->opened_by([&](const std::filesystem::path& path) {
        return Recorder::create(path, "imported from " + options.scene.filename().string(), recording);
    });
    if (!recorder) return recorder.error();
    return CaptureBeingWritten{*std::move(file), *std::move(recorder)};
}

Result<void> add_thumbnail(Recorder& recorder, const Result<std::optional<Texture>>& thumbnail) {
    if (!thumbnail) return thumbnail.error();
    return *thumbnail ? recorder.thumbnail(**thumbnail) : Result<void>();
}

/// Frames of a glTF scene, whose textures the recorder has been given. Each is written before the next one is handed over.
class SceneRecording {
public:
    explicit SceneRecording(Recorder& recorder) : recorder_(recorder) {}

    Result<void> add(Frame frame) {
        if (const auto written = recorder_.flush(); !written) return written;
        put_resources(frame);
        recorder_.begin_frame(frame.view, frame.time, frame.index, frame.seed);
        recorder_.draws(frame.draws);
        for (Light& light : frame.lights) recorder_.light(std::move(light));
        recorder_.environment(frame.sun, frame.hemisphere, frame.fog, frame.background);
        recorder_.camera(frame.lens, frame.film);
        return recorder_.end_frame();
    }

private:
    /// Materials stay as they are; meshes that no longer are become empty ones.
    void put_resources(Frame& frame) {
        if (meshes_ == 0)
            for (Material& material : frame.materials) recorder_.add_material(std::move(material));
        frame.meshes.resize(std::max<std::size_t>(frame.meshes.size(), meshes_));
        for (std::uint32_t i = 0; i < frame.meshes.size(); ++i) {
            if (i < meshes_) recorder_.update_mesh(i, std::move(frame.meshes[i]));
            else recorder_.add_mesh(std::move(frame.meshes[i]));
        }
        meshes_ = static_cast<std::uint32_t>(frame.meshes.size());
    }

    Recorder& recorder_;
    std::uint32_t meshes_ = 0;
};

/// The thumbnail of a deep image, by the exposure and the tone curve of its frame, without a device.
std::optional<Texture> developed(const Frame& frame, std::span<const glm::dvec3> preview) {
    const ThumbnailExtent extent = thumbnail_extent(frame.view.width, frame.view.height);
    HostImage display{.shape = {.extent = {extent.width, extent.height, 1}, .format = Format::rgba32f}, .texels = {}};
    std::vector<glm::vec4> texels;
    for (const glm::dvec3& radiance : preview) {
        glm::dvec4 texel(1);
        for (int c = 0; c < 3; ++c) texel[c] = tone_mapped(radiance[c] * double(frame.view.exposure), double(frame.film.white));
        texels.emplace_back(texel);
    }
    const auto bytes = std::as_bytes(std::span(texels));
    display.texels.assign(bytes.begin(), bytes.end());
    return thumbnail_of(display);
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) to_stderr("strata: warning: {}\n", warning);
}

Result<void> import_deep_image(const ImportArguments& options) {
    DeepOptions of_deep = options.of_deep;
    if (!options.window.empty() && (options.window[2] < 1 || options.window[3] < 1))
        return fail(Fault::usage, "options.out_of_range", "{option} takes a width and a height above 0, not {width} x {height}",
                    "--window", options.window[2], options.window[3]);
    of_deep.memory_budget = options.memory_budget;
    if (!options.window.empty())
        of_deep.window = DeepWindow{options.window[0], options.window[1], static_cast<std::uint32_t>(options.window[2]),
                                    static_cast<std::uint32_t>(options.window[3])};
    auto image = import_deep(options.scene, of_deep);
    if (!image) return image.error();
    print_warnings(image->warnings);
    auto output = begin_capture(options, room_for(image->frame));
    if (!output) return output.error();
    if (const auto done = add_thumbnail(output->recorder, developed(image->frame, image->preview)); !done) return done;
    if (const auto done = output->recorder.record(std::move(image->frame)); !done) return done;
    if (const auto done = output->finish(); !done) return done;
    const DeepCensus& census = image->census;
    to_stderr("imported {} of {} as {} in {}, {} in the deepest, into {}\n", plural(census.samples, "sample"),
              options.scene.filename().string(), plural(census.fragments, "fragment"), plural(census.pixels, "pixel"),
              census.deepest, output_of(options).string());
    return {};
}

/// By its first four bytes.
bool is_open_exr(const std::filesystem::path& path) {
    std::array<char, 4> first{};
    return std::ifstream(path, std::ios::binary).read(first.data(), first.size()) &&
           first == std::array{'\x76', '\x2f', '\x31', '\x01'};
}

std::vector<std::string> notes_on_view(const Frame& frame) {
    constexpr double little = 0.03;  // of the picture
    const double share = frame.draws.empty() ? 0 : seen_share(frame);
    if (share >= little) return {};
    return {fmt::format("the scene covers {:.1f} % of the picture; place the camera with --eye and --target, or with --inside",
                        100 * share)};
}

/// Frame after frame, so that an animation of a large scene never lies in memory as a whole. Returns what the last one holds.
Result<Counts> record_scene(const ImportArguments& options, GltfScene& scene, Recorder& recorder, std::vector<std::string>& notes,
                            const Progress& progress) {
    SceneRecording recording(recorder);
    Counts counts;
    for (std::uint32_t index = 0; index < options.frames; ++index) {
        show_frame(progress, index, options.frames);
        auto frame = scene.frame(index);
        if (!frame) return frame.error();
        counts = {frame->draws.size(), frame->materials.size(), frame->textures.size(), frame->lights.size()};
        if (index == 0) {
            notes = notes_on_view(*frame);
            const auto thumbnail = make_thumbnail(*frame, options.device);
            if (const auto done = add_thumbnail(recorder, thumbnail); !done) return done.error();
            if (*thumbnail) warn_of_darkness(**thumbnail);
        }
        if (const auto done = recording.add(*std::move(frame)); !done) return done.error();
    }
    return counts;
}

Result<void> import(const ImportArguments& options, const CLI::App& app) {
    if (options.deep) {
        const auto fits = check_not_given(app,
                                          {"--size", "--samples", "--camera", "--eye", "--target", "--inside", "--fov",
                                           "--azimuth", "--elevation", "--exposure", "--frames", "--fps", "--animation"},
                                          "a deep image is one frame with a view of its own");
        if (!fits) return fits;
        const auto no_device = check_not_given(app, {"--gpu"}, "a deep image is imported without a device");
        return no_device ? import_deep_image(options) : no_device;
    }
    if (options.frames == 1)
        if (const auto fits =
                check_not_given(app, {"--fps"}, "one frame is taken at the start of the animation; ask for more with --frames");
            !fits)
            return fits;
    if (is_open_exr(options.scene))
        return fail(Fault::usage, "import.needs_deep", "{file} is an OpenEXR image: pass --deep to import one with deep samples",
                    options.scene.string());
    const auto extent = extent_of(options.size);
    if (!extent) return extent.error();
    GltfOptions gltf = options.gltf;
    gltf.memory_budget = options.memory_budget;
    if (!options.eye.empty()) gltf.eye = glm::dvec3(options.eye[0], options.eye[1], options.eye[2]);
    if (!options.target.empty()) gltf.target = glm::dvec3(options.target[0], options.target[1], options.target[2]);
    std::tie(gltf.width, gltf.height) = *extent;
    // What is handed over is written before there is more, so the budget of the import bounds it.
    auto output = begin_capture(options, {.budget_bytes = std::numeric_limits<std::uint64_t>::max()});
    if (!output) return output.error();
    gltf.take_texture = [&output](Texture texture) {
        output->recorder.add_texture(std::move(texture));
        return output->recorder.flush();
    };
    const Progress progress = progress_line();
    progress("reading " + options.scene.filename().string(), 0);
    auto scene = GltfScene::open(options.scene, gltf);
    if (!scene) return scene.error();
    std::vector<std::string> notes;
    const auto last = record_scene(options, *scene, output->recorder, notes, progress);
    print_warnings(scene->warnings());
    print_warnings(notes);
    if (!last) return last.error();
    if (const auto done = output->finish(); !done) return done;
    to_stderr("imported {}, {}, {}, {}, {} into {}\n", plural(options.frames, "frame"), plural(last->draws, "draw"),
              plural(last->materials, "material"), plural(last->textures, "texture"), plural(last->lights, "light"),
              output_of(options).string());
    return {};
}

}  // namespace

std::function<Result<void>()> declare_import(CLI::App& app) {
    const auto options = std::make_shared<ImportArguments>();
    app.add_option("scene", options->scene, "a .gltf or .glb file; with --deep, a deep OpenEXR image")
        ->required()
        ->type_name(input_file);
    CLI::Option* deep = app.add_flag("--deep", options->deep, "read a deep image; its samples become transparent fragments");
    app.add_option("--part", options->of_deep.part, "name or index of the part of a deep file; default: its first deep part")
        ->needs(deep);
    app.add_option("--window", options->window, "pixels of a deep file to read, as X,Y,WIDTH,HEIGHT; default: its display window")
        ->delimiter(',')
        ->expected(4)
        ->check(from_to(std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()))
        ->needs(deep);
    app.add_option("-o,--output", options->output, "capture to write; default: the scene's name with .strata")
        ->type_name(output_file);
    app.add_option("--size", options->size, "extent as WIDTHxHEIGHT, default 640x360");
    app.add_option("--samples", options->gltf.samples, "samples per pixel")->check(one_or_four());
    app.add_option("--camera", options->gltf.camera,
                   "index of the scene's camera; default: the first, or without cameras one that frames the scene")
        ->check(from_to(0, std::numeric_limits<std::int32_t>::max()));
    app.add_option("--azimuth", options->gltf.azimuth,
                   "azimuth of the framing camera in degrees, 0 in front, positive to the right; default 22");
    app.add_option("--elevation", options->gltf.elevation,
                   "elevation of the framing camera in degrees above the horizon, default 16");
    constexpr double farthest = 1e12;  // meters; directions are still found, whose squares are beyond a double from 1e154 on
    const auto point = [&](const char* name, std::vector<double>& to, const char* help) {
        app.add_option(name, to, help)->delimiter(',')->expected(3)->check(from_to(-farthest, farthest));
    };
    point("--eye", options->eye, "position of the camera as X,Y,Z in meters; replaces the scene's camera");
    point("--target", options->target, "point the --eye camera looks at, as X,Y,Z in meters; default: the center of the scene");
    app.add_option("--fov", options->gltf.fov, "vertical field of view in degrees, for a camera that is not from the scene");
    app.add_option("--exposure", options->gltf.exposure,
                   "factor from radiance to what the film sees, above 0; default: 1, or what the scene's lights need");
    app.add_flag("--inside", options->gltf.inside,
                 "place the camera inside the scene, at the point with the longest view (for closed rooms)");
    app.add_option("--frames", options->frames, "number of frames to import, default 1; the animation loops")
        ->check(from_to(1, 100000));
    app.add_option("--fps", options->gltf.fps, "frames per second at which the animation is sampled, default 30");
    app.add_option("--animation", options->gltf.animation, "name or index of the animation; default: the first");
    app.add_option(
           "--budget,--memory-budget", options->memory_budget,
           "largest memory for the scene, like 4GiB; default: half of the machine's memory; exit code 4 if more is needed")
        ->transform(CLI::AsSizeValue(/*kb_is_1000=*/false));
    app.add_option("--gpu", options->device.gpu,
                   "device that renders the thumbnail of a glTF scene, by index or part of its name");
    return [options, &app] { return import(*options, app); };
}

}  // namespace strata
