#include "replay/cli/verb_options.h"

#include <algorithm>
#include <charconv>

#include <CLI/CLI.hpp>

#include "capture_format/container/picture.h"
#include "capture_format/nearest_name.h"
#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "passes/frame_images.h"
#include "replay/cli/given_options.h"
#include "replay/images/image_io.h"
#include "replay/plural.h"
#include "replay/session/choice_text.h"

namespace strata {
namespace {

template <typename Number>
bool parse(std::string_view text, Number& number) {
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    return problem == std::errc() && end == text.data() + text.size();
}

void say_what_is_left_out(const Capture& capture) {
    for (const std::string& sentence : capture.summary().left_out) to_stderr("strata: {}\n", sentence);
}

/// The frame at the extent of a thumbnail.
Frame small(Frame frame) {
    const ThumbnailExtent extent = thumbnail_extent(frame.view.width, frame.view.height);
    frame.view.width = extent.width;
    frame.view.height = extent.height;
    // Each cascade draws the scene once more, and one has more texels than a thumbnail has pixels.
    frame.sun.cascades = 1;
    return frame;
}

}  // namespace

void add_options(CLI::App& app, DeviceChoice& device) {
    constexpr const char* group = "Device";
    app.add_option("--gpu", device.gpu, "device by index or part of its name (strata --list-gpus)")->group(group);
    app.add_option("--without", device.without, "treat the device as lacking this Vulkan feature or capability; repeatable")
        ->allow_extra_args(false)
        ->group(group);
    app.add_flag("--validation", device.validation, "turn on the validation layer; any message fails the run")->group(group);
    app.add_option("--memory-budget", device.memory_budget,
                   "largest device memory and largest size of unpacked files, like 256MiB; exit code 4 if more is needed")
        ->transform(CLI::AsSizeValue(/*kb_is_1000=*/false))
        ->group(group);
}

void add_options(CLI::App& app, OpenOptions& options) {
    app.add_option("capture", options.capture, "capture (.strata file)")->required()->type_name(input_file);
    add_options(app, options.device);
    app.add_flag("--allow-partial", options.allow_partial, "read the complete frames of a truncated file");
}

Result<std::unique_ptr<Session>> open(const OpenOptions& options) {
    auto session = Session::open(options.capture, options.device, options.allow_partial ? Partial::allowed : Partial::refused);
    if (session) say_what_is_left_out(*(*session)->capture());
    return session;
}

void add_memory_budget(CLI::App& app, std::uint64_t& bytes) {
    app.add_option(
           "--memory-budget", bytes,
           "largest size of an unpacked file, like 4GiB; default: half of the machine's memory; exit code 4 if more is needed")
        ->transform(CLI::AsSizeValue(/*kb_is_1000=*/false));
}

Result<Capture> open_capture(const std::filesystem::path& path, Partial partial, std::uint64_t memory_budget) {
    auto capture = Capture::open(path, partial, memory_budget);
    if (!capture) return capture;
    say_what_is_left_out(*capture);
    if (capture->frame_count() == 0) return fail(Fault::bad_input, "capture.no_frames", "{file} holds no frame", path.string());
    return capture;
}

void add_options(CLI::App& app, ChoiceOptions& options) {
    app.add_option("--use", options.uses, "technique to use, as stage/technique; repeatable")->allow_extra_args(false);
    app.add_option("--set", options.sets, "parameter to set, as key=value or stage/technique:key=value; repeatable")
        ->allow_extra_args(false);
    app.add_option("--force", options.force, "turn on a feature that the frame lacks, or 'all'")->allow_extra_args(false);
    app.add_option("--samples", options.samples, "replace the recorded samples per pixel")->check(one_or_four());
}

void add_eye(CLI::App& app, std::string& eye) {
    app.add_option("--eye", eye,
                   "move the camera: dolly, truck, pedestal (meters ahead, right, up), pan, tilt, roll (radians), "
                   "like pan=0.5,dolly=1");
}

Result<Request> request_of(const ChoiceOptions& options) {
    auto choices = parse_choices(options.uses, options.sets);
    if (!choices) return choices.error();
    Request request;
    request.choices = *std::move(choices);
    request.variant.samples = options.samples;
    for (const std::string& text : options.force) {
        if (text == "all") {
            request.variant.force.assign(all_features().begin(), all_features().end());
            continue;
        }
        const auto feature = find_feature(text);
        std::vector<std::string_view> known;
        for (const Feature candidate : all_features()) known.push_back(name(candidate));
        if (!feature)
            return fail(Fault::usage, "feature.unknown", "there is no feature '{feature}'{suggestion}", text,
                        did_you_mean(text, known));
        request.variant.force.push_back(*feature);
    }
    return request;
}

Result<std::vector<std::size_t>> frame_indices(const std::string& text, std::size_t count) {
    std::vector<std::size_t> indices;
    if (text.empty())
        for (std::size_t i = 0; i < count; ++i) indices.push_back(i);
    std::size_t begin = 0;
    while (!text.empty() && begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string_view part = std::string_view(text).substr(begin, end - begin);
        const std::size_t dash = part.find('-');
        std::size_t first = 0, last = 0;
        const bool good =
            parse(part.substr(0, dash), first) && (dash == part.npos ? (last = first, true) : parse(part.substr(dash + 1), last));
        if (!good || last < first)
            return fail(Fault::usage, "options.malformed", "{option} takes a list like 0,4-8, not '{value}'", "--frames", text);
        if (last >= count)
            return fail(Fault::usage, "capture.no_frame", "there is no frame {frame}: the capture has {frames}, numbered from 0",
                        last, count);
        for (std::size_t i = first; i <= last; ++i) {
            if (std::ranges::count(indices, i) > 0)
                return fail(Fault::usage, "options.value_twice", "{option} gives '{value}' twice", "--frames", i);
            indices.push_back(i);
        }
        begin = end + 1;
    }
    return indices;
}

Result<void> make_folder(const std::filesystem::path& folder) {
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    return problem ? Result<void>(fail(Fault::usage, "file.cannot_make_folder", "cannot make the folder {folder}: {reason}",
                                       folder.string(), problem.message()))
                   : Result<void>();
}

std::string command_line(const CLI::App& verb) {
    std::string line = "strata " + verb.get_name();
    for (const CLI::Option* option : verb.get_options()) {
        if (option->count() == 0) continue;
        const bool flag = option->get_items_expected_max() == 0;
        for (const std::string& value : option->results()) {
            if (!option->get_positional()) line.append(" ").append(option->get_name());
            if (!flag) line.append(" ").append(as_shell_word(value));
        }
    }
    return line;
}

Result<std::pair<std::uint32_t, std::uint32_t>> extent_of(const std::string& text) {
    const std::size_t cross = text.find('x');
    std::pair<std::uint32_t, std::uint32_t> extent;
    if (cross == text.npos || !parse(std::string_view(text).substr(0, cross), extent.first) ||
        !parse(std::string_view(text).substr(cross + 1), extent.second) || extent.first == 0 || extent.second == 0 ||
        extent.first > 16384 || extent.second > 16384)
        return fail(Fault::usage, "options.malformed", "{option} takes WIDTHxHEIGHT, each from 1 to 16384, not '{value}'",
                    "--size", text);
    return extent;
}

Texture thumbnail_of(const HostImage& display) {
    Texture texture{.name = "thumbnail", .format = TextureFormat::rgba8_srgb};
    texture.width = display.shape.extent.width;
    texture.height = display.shape.extent.height;
    for (std::uint32_t y = 0; y < texture.height; ++y)
        for (std::uint32_t x = 0; x < texture.width; ++x) {
            const glm::dvec4 color = texel(display, x, y);
            for (int c = 0; c < 3; ++c) texture.texels.push_back(display_byte(color[c]));
            texture.texels.push_back(std::byte{255});
        }
    return texture;
}

Result<std::optional<Texture>> make_thumbnail(const Frame& frame, const DeviceChoice& device) {
    // Replayed small and with one sample: 640 x 360 with 4 samples of thick smoke took lavapipe minutes.
    auto session = Session::open(std::vector<Frame>{small(frame)}, device);
    const auto run = session ? (*session)->run({.variant = {.samples = 1}}) : Result<Run>(session.error());
    if (!run && (run.error().fault == Fault::usage || !device.gpu.empty())) return run.error();  // a device that was asked for
    if (!run) {
        to_stderr("strata: no thumbnail: {}\n", run.error().sentence);
        return std::optional<Texture>();
    }
    const auto display = run->images.find("display");
    return display == run->images.end() ? std::optional<Texture>() : thumbnail_of(display->second);
}

}  // namespace strata
