// strata info: what a capture holds and what its frames call for. strata validate: whether all of it is sound.
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "capture_format/check_capture.h"
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/stage_choice.h"
#include "capture_format/frame/texture.h"
#include "capture_format/reader.h"
#include "passes/stages.h"
#include "replay/cli/verb_options.h"
#include "replay/error_text.h"
#include "replay/expectations/expectation.h"
#include "replay/json_text.h"
#include "replay/plural.h"
#include "replay/session/choices.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

struct InfoArguments {
    std::filesystem::path capture;
    std::size_t frame = 0;
    std::uint64_t memory_budget = 0;
    bool allow_partial = false, json = false;
};

struct Count {
    const char *name, *one;
    std::size_t value;
};

std::vector<Count> counts(const Frame& frame) {
    std::size_t triangles = 0, particles = 0;
    for (const Draw& draw : frame.draws) triangles += frame.meshes[draw.mesh].indices.size() / 3;
    for (const Emitter& emitter : frame.emitters) particles += emitter.particles.size();
    return {{"draws", "draw", frame.draws.size()},
            {"triangles", "triangle", triangles},
            {"meshes", "mesh", frame.meshes.size()},
            {"materials", "material", frame.materials.size()},
            {"textures", "texture", frame.textures.size()},
            {"emitters", "emitter", frame.emitters.size()},
            {"particles", "particle", particles},
            {"lights", "light", frame.lights.size()},
            {"blockers", "blocker", frame.blockers.size()},
            {"portals", "portal", frame.portals.size()},
            {"light_volumes", "light volume", frame.light_volumes.size()}};
}

ordered_json json_of(const Capture& capture, const Frame& frame, std::size_t index) {
    const CaptureSummary& summary = capture.summary();
    ordered_json json{{"schema", "strata.info"},
                      {"schema_version", 1},
                      {"capture", capture.id()},
                      {"format_version", summary.format_version},
                      {"frames", summary.frames},
                      {"file_bytes", summary.file_bytes},
                      {"blobs", summary.blobs},
                      {"blob_bytes_stored", summary.blob_bytes_stored},
                      {"blob_bytes_raw", summary.blob_bytes_raw},
                      {"cut_short", summary.cut_short},
                      {"notes", summary.notes}};
    ordered_json& of_frame = json["frame"];
    of_frame = {{"index", index}, {"extent", {frame.view.width, frame.view.height}}, {"samples", frame.view.samples}};
    for (const Count& count : counts(frame)) of_frame[count.name] = count.value;
    const Features features = frame_features(frame);
    of_frame["features"] = ordered_json::object();
    for (const Feature feature : all_features())
        if (features.has(feature)) of_frame["features"][std::string(name(feature))] = features.reason(feature);
    ordered_json& recorded_with = of_frame["recorded_with"] = ordered_json::array();
    for (const StageChoice& choice : frame.recorded_with) {
        recorded_with.push_back({{"stage", choice.stage}, {"technique", choice.technique}, {"settings", ordered_json::object()}});
        for (const Setting& setting : choice.settings)
            recorded_with.back()["settings"][setting.key] =
                std::visit([](const auto& value) { return ordered_json(value); }, setting.value);
    }
    return json;
}

void print(const Capture& capture, const Frame& frame, std::size_t index) {
    const CaptureSummary& summary = capture.summary();
    to_stdout("capture {}, format {}, {}, {} bytes{}\n", capture.id(), summary.format_version, plural(summary.frames, "frame"),
              summary.file_bytes, summary.cut_short ? ", CUT SHORT" : "");
    if (!summary.notes.empty()) to_stdout("notes: {}\n", summary.notes);
    to_stdout("{} of meshes, textures and particles: {} bytes, {} unpacked\n", plural(summary.blobs, "blob"),
              summary.blob_bytes_stored, summary.blob_bytes_raw);
    to_stdout("\nframe {}: {} x {}, {} per pixel, time {:.3f} s\n", index, frame.view.width, frame.view.height,
              plural(frame.view.samples, "sample"), frame.time);
    for (const Count& count : counts(frame))
        if (count.value) to_stdout("  {:>8} {}\n", count.value, count.value == 1 ? count.one : count.name);
    to_stdout("it calls for\n");
    const Features features = frame_features(frame);
    for (const Feature feature : all_features())
        if (features.has(feature)) to_stdout("  {:<18} {}\n", name(feature), features.reason(feature));
    for (const StageChoice& choice : frame.recorded_with) {
        to_stdout("recorded with {} for {}", choice.technique, choice.stage);
        for (const Setting& setting : choice.settings)
            std::visit([&](const auto& value) { to_stdout(" {}={}", setting.key, value); }, setting.value);
        to_stdout("\n");
    }
}

Result<void> info(const InfoArguments& options) {
    const auto capture =
        open_capture(options.capture, options.allow_partial ? Partial::allowed : Partial::refused, options.memory_budget);
    if (!capture) return capture.error();
    const std::size_t count = capture->frame_count();
    if (options.frame >= count)
        return fail(Fault::usage, "capture.no_frame", "there is no frame {frame}: the capture has {frames}, numbered from 0",
                    options.frame, count);
    const auto frame = capture->frame(options.frame);
    if (!frame) return frame.error();
    if (const auto understood = choose(*frame); !understood) return within(understood.error(), "frame {frame}", options.frame);
    if (options.json) write_stdout(json_text(json_of(*capture, *frame, options.frame)));
    else print(*capture, *frame, options.frame);
    return {};
}

/// Whether expectations can be read, and every image that they keep is there.
Result<void> check_texts(const Capture& capture) {
    const auto expectations = expectations_of(capture);
    if (!expectations) return expectations.error();
    for (const Expectation& expectation : *expectations)
        for (const ExpectedPass& pass : expectation.passes)
            for (const ExpectedImage& image : pass.images) {
                if (image.texels.empty()) continue;
                if (const auto kept = capture.expected_image(image.texels, bytes(image.shape)); !kept) return kept.error();
            }
    return {};
}

Result<Capture> validated(const InfoArguments& options) {
    auto capture = open_capture(options.capture, Partial::refused, options.memory_budget);
    if (!capture) return capture;
    const auto understands = [](const Frame& frame) { return choose(frame).and_then([](Choices&) { return Result<void>(); }); };
    if (const auto sound = check_capture(options.capture, options.memory_budget, understands); !sound) return sound.error();
    if (const auto sound = check_texts(*capture); !sound) return within(sound.error(), "{capture}", options.capture.string());
    return capture;
}

Result<void> validate(const InfoArguments& options) {
    const auto capture = validated(options);
    if (options.json) {
        ordered_json json{{"schema", "strata.validate"}, {"schema_version", 2}};
        if (capture) json.update({{"capture", capture->id()}, {"frames", capture->frame_count()}});
        json["is_sound"] = bool(capture);
        if (!capture) json["error"] = json_of(capture.error());
        write_stdout(json_text(json));
    }
    if (!capture) return capture.error();
    if (options.json) return {};
    to_stdout("{}: {}, every byte, index, blob and expectation is sound\n", options.capture.filename().string(),
              plural(capture->frame_count(), "frame"));
    return {};
}

}  // namespace

std::function<Result<void>()> declare_info(CLI::App& app) {
    const auto options = std::make_shared<InfoArguments>();
    app.add_option("capture", options->capture, "capture (.strata file)")->required()->type_name(input_file);
    app.add_option("--frame", options->frame, "index of the frame, default 0");
    app.add_flag("--allow-partial", options->allow_partial, "read the complete frames of a truncated file");
    add_memory_budget(app, options->memory_budget);
    app.add_flag("--json", options->json, "print JSON instead of text");
    return [options] { return info(*options); };
}

std::function<Result<void>()> declare_validate(CLI::App& app) {
    const auto options = std::make_shared<InfoArguments>();
    app.add_option("capture", options->capture, "capture (.strata file)")->required()->type_name(judged_file);
    app.add_flag("--json", options->json, "print JSON instead of text");
    add_memory_budget(app, options->memory_budget);
    return [options] { return validate(*options); };
}

}  // namespace strata
