// check_frame(): after it the rest of the program indexes freely. It refuses what no stage could replay and lets through what
// a stage must survive: vertex and particle colors, alphas, depth offsets, normals and float texels may be NaN or infinite.
#include <cmath>

#include "capture_format/inspection.h"
#include "capture_format/reader.h"

namespace strata {
namespace {

/// Vulkan's clip space of frame.h: reversed depth, infinite far plane, y downwards.
void inspect_projection(Inspection& inspection, const View& view) {
    const glm::mat4& p = view.projection;
    for (int column = 0; column < 4; ++column) {
        inspection.expect(finite(p[column]), "the projection's column {} is not finite", column);
    }
    const bool zeros = p[0][1] == 0 && p[0][2] == 0 && p[0][3] == 0 && p[1][0] == 0 && p[1][2] == 0 && p[1][3] == 0 &&
                       p[2][2] == 0 && p[3][0] == 0 && p[3][1] == 0 && p[3][3] == 0;
    inspection.expect(zeros && p[2][3] == 1,
                      "the projection is not of the reversed infinite form (P00 x + P20 z, -(P11 y + P21 z), near, z)");
    inspection.expect(p[0][0] > 0 && p[1][1] < 0, "the projection must keep x and flip y, not scale by {} and {}", p[0][0],
                      p[1][1]);
    inspection.expect(std::abs(p[3][2] - view.near) <= 1e-5f * view.near, "the projection's near plane is {}, the view's {}",
                      p[3][2], view.near);
}

void inspect_view(Inspection& inspection, const View& view) {
    inspection.at({.kind = "view"});
    inspection.expect(within(view.width, 1, largest_extent) && within(view.height, 1, largest_extent),
                      "the extent must be 1 to {} pixels each way, not {} x {}", largest_extent, view.width, view.height);
    inspection.expect(view.samples == 1 || view.samples == 4, "samples must be 1 or 4, not {}", view.samples);
    inspection.expect(finite(view.origin), "the origin is not finite");
    inspection.expect(positive(view.near), "the near plane must lie in front of the eye, not at {} m", view.near);
    inspection.expect(positive(view.exposure), "the exposure must be above 0, not {}", view.exposure);
    inspection.expect(within(view.jitter.x, -1, 1) && within(view.jitter.y, -1, 1), "the jitter must be -1 to 1 NDC");
    for (int i = 0; i < 3; ++i) {
        const int next = (i + 1) % 3;
        inspection.expect(finite(view.to_view[i]) && unit(view.to_view[i]) && perpendicular(view.to_view[i], view.to_view[next]),
                          "to_view must be a rotation: its column {} is not unit or not perpendicular to the next", i);
    }
    inspect_projection(inspection, view);
}

void inspect_environment(Inspection& inspection, const Frame& frame) {
    inspection.at({.kind = "environment"});
    inspection.expect(finite(frame.hemisphere.sky) && finite(frame.hemisphere.ground), "the hemisphere's light is not finite");
    inspection.expect(finite(frame.background), "the background is not finite");
    inspection.expect(finite(frame.fog.color), "the fog's color is not finite");
    inspection.expect(positive_or_zero(frame.fog.density), "the fog's density must be 0 or above, not {}", frame.fog.density);
    inspection.expect(known(frame.fog.path, FogPath::distance), "there is no path of fog {}",
                      static_cast<std::uint32_t>(frame.fog.path));
    inspection.expect(within(frame.rain.intensity, 0, 1), "the rain's intensity must be 0 to 1, not {}", frame.rain.intensity);
    inspection.expect(within(frame.rain.wetness, 0, 1), "the wetness must be 0 to 1, not {}", frame.rain.wetness);
    inspection.expect(finite(frame.rain.direction) && unit(frame.rain.direction), "the rain's direction must be unit");
}

void inspect_camera(Inspection& inspection, const Lens& lens, const Film& film) {
    inspection.at({.kind = "camera"});
    inspection.expect(positive_or_zero(lens.bloom), "bloom must be 0 or above, not {}", lens.bloom);
    inspection.expect(positive_or_zero(lens.bloom_threshold), "the bloom threshold must be 0 or above, not {}",
                      lens.bloom_threshold);
    inspection.expect(positive_or_zero(lens.exposure_speed), "the exposure speed must be 0 or above, not {}",
                      lens.exposure_speed);
    inspection.expect(positive_or_zero(lens.focus_distance), "the focus distance must be 0 m or above, not {}",
                      lens.focus_distance);
    inspection.expect(positive_or_zero(lens.aperture), "the aperture must be 0 m or above, not {}", lens.aperture);
    inspection.expect(positive_or_zero(film.grain), "the grain must be 0 or above, not {}", film.grain);
    inspection.expect(positive_or_zero(film.fade), "the fade must be 0 or above, not {}", film.fade);
    inspection.expect(positive(film.white), "the film's white must be above 0, not {}", film.white);
}

void inspect_choices(Inspection& inspection, const Frame& frame) {
    for (std::size_t i = 0; i < frame.recorded_with.size(); ++i) {
        const StageChoice& choice = frame.recorded_with[i];
        inspection.at({"stage choice", i, choice.stage});
        inspection.expect(choice.stage.size() <= longest_text && choice.technique.size() <= longest_text,
                          "names may have {} bytes", longest_text);
        for (const Setting& setting : choice.settings) {
            const std::string* text = std::get_if<std::string>(&setting.value);
            inspection.expect(setting.key.size() <= longest_text && (!text || text->size() <= longest_text),
                              "keys and texts of settings may have {} bytes", longest_text);
            const double* number = std::get_if<double>(&setting.value);
            inspection.expect(!number || finite(*number), "setting '{}' is not finite", setting.key);
        }
    }
}

}  // namespace

Error Inspection::located(std::string_view sentence) const {
    if (subject_.kind.empty()) return fail_unnamed(Fault::bad_input, "{}", sentence);
    if (subject_.index == Subject::only_one) return fail_unnamed(Fault::bad_input, "{}: {}", subject_.kind, sentence);
    if (subject_.name.empty()) return fail_unnamed(Fault::bad_input, "{} {}: {}", subject_.kind, subject_.index, sentence);
    // A name may be far too long to print; that it is too long is said by the sentence.
    return fail_unnamed(Fault::bad_input, "{} {} '{}': {}", subject_.kind, subject_.index, subject_.name.substr(0, 60), sentence);
}

Result<void> check_submissions(const Frame& frame, const ResourceShapes& resources) {
    Inspection inspection;
    inspection.expect(finite(frame.time), "the frame's time is not finite");
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
