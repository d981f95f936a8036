// A pyramid turns in the light of a lamp: 12 frames.
#include <cstdio>

#include <strata/recorder.h>
#include <glm/gtc/matrix_transform.hpp>

/// Counter-clockwise seen from outside. Without normals every triangle is flat.
strata::Mesh pyramid() {
    return {.name = "pyramid",
            .positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {0, 2, 0}},
            .indices = {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}};
}

strata::Material paint_at(double time) {
    return {.name = "paint", .base_color = {.8, .2, .1, 1}, .roughness = static_cast<float>(1 - time)};
}

glm::dmat4 turned(double time) { return glm::rotate(glm::dmat4(1), time, glm::dvec3(0, 1, 0)); }

strata::Result<void> render(const char* file) {
    auto recorder = strata::Recorder::create(file);
    if (!recorder) return recorder.error();
    const std::uint32_t mesh = recorder->add_mesh(pyramid());  // resources stay until they are updated
    const std::uint32_t paint = recorder->add_material(paint_at(0));
    const strata::View view = strata::look_at({.eye = {2, 3, 5}, .target = {0, .8, 0}, .width = 320, .height = 180});
    const double step = 1 / 30.;
    for (std::uint64_t frame = 0; frame < 12; ++frame) {
        const double time = static_cast<double>(frame) * step;
        recorder->begin_frame(view, time, frame, /*seed*/ 0);
        recorder->update_material(paint, paint_at(time));
        recorder->draw({.mesh = mesh, .material = paint, .to_world = turned(time), .previous_to_world = turned(time - step)});
        recorder->light({.name = "lamp", .position = {2, 4, 3}, .intensity = {60, 60, 60}});
        if (const auto done = recorder->end_frame(); !done) return done;  // hands over; a thread of its own writes
    }
    return recorder->finish();
}

int main() {
    const auto done = render("frames.strata");
    if (!done) std::fprintf(stderr, "%s\n", done.error().sentence.c_str());
    return done ? 0 : 1;
}
