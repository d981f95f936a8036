// check_frame(): after it the rest of the program indexes freely. It refuses what no stage could replay and lets through what
// a stage must survive: vertex and particle colors, alphas, depth offsets, normals and float texels may be NaN or infinite.
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/lens.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/stage_choice.h"
#include "capture_format/frame/texture.h"
#include "capture_format/frame/weather.h"
#include "capture_format/inspection.h"
#include "capture_format/reader.h"
#include "capture_format/view.h"

namespace strata {
namespace {

/// Vulkan's clip space of frame.h: reversed depth, infinite far plane, y downwards.
void inspect_projection(Inspection& inspection, const View& view) {
    const glm::mat4& p = view.projection;
    for (int column = 0; column < 4; ++column) {
        inspection.at({.kind = "view", .part = "projection column", .part_index = static_cast<std::size_t>(column)});
        inspection.expect_finite("a number", p[column]);
    }
    inspection.at({.kind = "view"});
    const bool zeros = p[0][1] == 0 && p[0][2] == 0 && p[0][3] == 0 && p[1][0] == 0 && p[1][2] == 0 && p[1][3] == 0 &&
                       p[2][2] == 0 && p[3][0] == 0 && p[3][1] == 0 && p[3][3] == 0;
    inspection.expect(zeros && p[2][3] == 1, "frame.projection_form",
                      "the projection is not of the reversed infinite form (P00 x + P20 z, -(P11 y + P21 z), near, z)");
    inspection.expect(p[0][0] > 0 && p[1][1] < 0, "frame.projection_flip",
                      "the projection must keep x and flip y, not scale by {x} and {y}", p[0][0], p[1][1]);
    inspection.expect(std::abs(p[3][2] - view.near) <= 1e-5f * view.near, "frame.near_planes",
                      "the projection's near plane is at {projection_near} m, the view's at {near} m", p[3][2], view.near);
}

void inspect_view(Inspection& inspection, const View& view) {
    inspection.at({.kind = "view"});
    inspection.expect_extent(view.width, view.height);
    inspection.expect(view.samples == 1 || view.samples == 4, "frame.samples", "samples must be 1 or 4, not {samples}",
                      view.samples);
    inspection.expect_finite("origin", view.origin);
    inspection.expect_positive("distance of the near plane in meters", view.near);
    inspection.expect_within("exposure", view.exposure, 1.2e-38, 3.4e38);  // what a float and a device hold, and 1 over it
    inspection.expect_within("jitter x in NDC", view.jitter.x, -1, 1);
    inspection.expect_within("jitter y in NDC", view.jitter.y, -1, 1);
    for (int i = 0; i < 3; ++i) {
        const int next = (i + 1) % 3;
        inspection.expect(finite(view.to_view[i]) && unit(view.to_view[i]) && perpendicular(view.to_view[i], view.to_view[next]),
                          "frame.not_rotation",
                          "to_view must be a rotation: column {column} is not unit or not perpendicular to the next", i);
    }
    inspect_projection(inspection, view);
}

void inspect_environment(Inspection& inspection, const Frame& frame) {
    inspection.at({.kind = "environment"});
    inspection.expect_finite("hemisphere's sky", frame.hemisphere.sky);
    inspection.expect_finite("hemisphere's ground", frame.hemisphere.ground);
    inspection.expect_finite("background", frame.background);
    inspection.expect_finite("fog color", frame.fog.color);
    inspection.expect_not_negative("fog density", frame.fog.density);
    inspection.expect_known("fog path", frame.fog.path, FogPath::distance);
    inspection.expect_within("rain intensity", frame.rain.intensity, 0, 1);
    inspection.expect_within("wetness", frame.rain.wetness, 0, 1);
    inspection.expect_unit("rain direction", frame.rain.direction);
}

void inspect_camera(Inspection& inspection, const Lens& lens, const Film& film) {
    inspection.at({.kind = "camera"});
    inspection.expect_not_negative("bloom", lens.bloom);
    inspection.expect_not_negative("bloom threshold", lens.bloom_threshold);
    inspection.expect_not_negative("exposure speed", lens.exposure_speed);
    inspection.expect_not_negative("focus distance in meters", lens.focus_distance);
    inspection.expect_not_negative("aperture in meters", lens.aperture);
    inspection.expect_not_negative("grain", film.grain);
    inspection.expect_not_negative("fade", film.fade);
    inspection.expect_within("film's white", film.white, 1e-18, 1e18);  // its square divides
}

void inspect_choices(Inspection& inspection, const Frame& frame) {
    for (std::size_t i = 0; i < frame.recorded_with.size(); ++i) {
        const StageChoice& choice = frame.recorded_with[i];
        inspection.at({"stage choice", i, choice.stage});
        inspection.expect_name(choice.stage);
        inspection.expect_name(choice.technique);
        for (const Setting& setting : choice.settings) {
            inspection.expect_name(setting.key);
            if (const auto* text = std::get_if<std::string>(&setting.value)) inspection.expect_name(*text);
            if (const auto* number = std::get_if<double>(&setting.value)) inspection.expect_finite(setting.key, *number);
        }
    }
}

}  // namespace

Error too_long_name(std::size_t bytes) {
    return fail(Fault::bad_input, "frame.name_too_long", "a name or text of {bytes} bytes is too long; the limit is {most}",
                bytes, longest_text);
}

Error Inspection::located(Error error) const {
    if (!subject_.part.empty()) error = within(error, "{part} {part_number}", subject_.part, subject_.part_index);
    if (subject_.kind.empty()) return error;
    if (subject_.index == Subject::only_one) return within(error, "{subject}", subject_.kind);
    if (subject_.name.empty()) return within(error, "{subject} {number}", subject_.kind, subject_.index);
    // A name may be far too long to print; frame.name_too_long says that it is.
    return within(error, "{subject} {number} '{name}'", subject_.kind, subject_.index, subject_.name.substr(0, 60));
}

Result<void> check_submissions(const Frame& frame, const ResourceShapes& resources) {
    Inspection inspection;
    inspection.expect_finite("time", frame.time);
    inspect_view(inspection, frame.view);
    inspect_environment(inspection, frame);
    inspect_camera(inspection, frame.lens, frame.film);
    inspect_choices(inspection, frame);
    inspect_submissions(inspection, frame, resources);
    inspect_lights(inspection, frame, resources.textures);
    return inspection.verdict();
}

Result<void> check_frame(const Frame& frame) {
    Inspection inspection;
    ResourceShapes resources{.textures = frame.textures.size(), .meshes = {}, .materials = frame.materials};
    for (std::size_t i = 0; i < frame.textures.size(); ++i) {
        inspection.at({"texture", i, frame.textures[i].name});
        inspect_texture(inspection, frame.textures[i]);
    }
    for (std::size_t i = 0; i < frame.meshes.size(); ++i) {
        const Mesh& mesh = frame.meshes[i];
        inspection.at({"mesh", i, mesh.name});
        inspect_mesh(inspection, mesh);
        resources.meshes.push_back({mesh.name, mesh.positions.empty(), !mesh.uv0.empty(), !mesh.uv1.empty()});
    }
    return inspection.failed() ? inspection.verdict() : check_submissions(frame, resources);
}

}  // namespace strata
