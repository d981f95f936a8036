#include "ui/picture/camera.h"

#include <algorithm>
#include <cmath>

#include "passes/scene/scene_facts.h"
#include "ui/window/keys.h"

namespace strata::ui {
namespace {

// A pull across 1000 pixels turns once around, nearly.
constexpr double radians_per_pixel = 0.006;
// Nobody looks over their own head: the picture would turn upside down.
constexpr double steepest = 1.55;
// A frame that waited for something to happen is no time flown.
constexpr double longest_frame = 0.1;
constexpr double faster = 4, least_speed = .05, most_speed = 200;
// One sample's depth is as good as another's here; a frame always has this one where it has depth.
constexpr const char* depth_image = "depth_layers";

bool is_down(std::string_view name) { return ImGui::IsKeyDown(chord_of(name)->key); }

double along(std::string_view forth, std::string_view back) { return is_down(forth) - is_down(back); }

}  // namespace

View flown(const View& view, const Flight& flight) {
    const double pitch = std::asin(std::clamp(view.to_view[1][2], -1.0, 1.0)), most = std::max(steepest, std::abs(pitch));
    const double turn_up = std::clamp(pitch + flight.turn_up, -most, most) - pitch;
    // Around a point at no distance the eye turns where it is: it goes left around it to look right.
    const View turned = orbited(view, {.distance = 0, .right = -flight.turn_right, .over = -turn_up});
    return moved(turned, {.dolly = flight.ahead, .truck = flight.right, .pedestal = flight.up});
}

std::optional<double> distance_at(const HostImage& depth, const View& view, glm::ivec2 pixel) {
    const Extent& extent = depth.shape.extent;
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= static_cast<int>(extent.width) || pixel.y >= static_cast<int>(extent.height))
        return {};
    const double reversed = texel(depth, static_cast<std::uint32_t>(pixel.x), static_cast<std::uint32_t>(pixel.y)).x;
    return reversed > 0 ? std::optional(double{view.near} / reversed) : std::nullopt;
}

void Camera::begin(Model& model, const Services& services, const Placement& placement) {
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemHovered() && io.KeyAlt) model.want(depth_image);
    if (!ImGui::IsItemActivated()) return;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) hold_ = Hold::fly;
    if (!io.KeyAlt || !ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return;
    hold_ = Hold::orbit;
    const auto replay = services.replayer.shown("A");
    const auto depth = replay ? replay->image(replay, depth_image) : nullptr;
    if (!depth) return;
    if (const auto distance = distance_at(*depth, replay->frame.bare.view, placement.texel_at(mouse_point())))
        distance_ = *distance;
}

Flight Camera::flight() const {
    const ImGuiIO& io = ImGui::GetIO();
    const double step = speed_ * (io.KeyShift ? faster : 1) * std::min(double{io.DeltaTime}, longest_frame);
    return {.ahead = along("w", "s") * step,
            .right = along("d", "a") * step,
            .up = along("e", "q") * step,
            .turn_right = double{io.MouseDelta.x} * radians_per_pixel,
            .turn_up = double{-io.MouseDelta.y} * radians_per_pixel};
}

void Camera::move(Model& model, const Services& services, const Placement& placement) {
    if (!model.is_known()) return;
    begin(model, services, placement);
    // What the mouse moved before the press is no pull.
    if (hold_ == Hold::none || ImGui::IsItemActivated()) return;
    if (!ImGui::IsItemActive()) {
        hold_ = Hold::none;
        return;
    }
    const ImGuiIO& io = ImGui::GetIO();
    const View& recorded = model.facts().bare.view;
    const View now = moved(recorded, model.edits().variant.eye);
    if (hold_ == Hold::orbit) {
        if (io.MouseDelta.x == 0 && io.MouseDelta.y == 0) return;
        const Orbit orbit{.distance = distance_,
                          .right = double{-io.MouseDelta.x} * radians_per_pixel,
                          .over = double{io.MouseDelta.y} * radians_per_pixel};
        return model.look_from(move_between(recorded, orbited(now, orbit)));
    }
    speed_ = std::clamp(speed_ * std::pow(1.25, double{io.MouseWheel}), least_speed, most_speed);
    if (const Flight by = flight(); by != Flight{}) model.look_from(move_between(recorded, flown(now, by)));
}

}  // namespace strata::ui
