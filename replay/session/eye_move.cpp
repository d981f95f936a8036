#include "replay/session/eye_move.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/ranges.h>
#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/nearest_name.h"

namespace strata {
namespace {

constexpr EyeAxis axes[] = {
    {"dolly", &EyeMove::dolly}, {"truck", &EyeMove::truck}, {"pedestal", &EyeMove::pedestal},
    {"pan", &EyeMove::pan},     {"tilt", &EyeMove::tilt},   {"roll", &EyeMove::roll},
};

// Turns of what is seen, in view space (+x right, +y up, +z ahead); columns: where x, y and z go. The eye's turn to the right
// takes what is seen to the left.
glm::dmat3 panned(double right) {
    const double c = std::cos(right), s = std::sin(right);
    return {{c, 0, s}, {0, 1, 0}, {-s, 0, c}};
}
glm::dmat3 tilted(double up) {
    const double c = std::cos(up), s = std::sin(up);
    return {{1, 0, 0}, {0, c, s}, {0, -s, c}};
}
glm::dmat3 rolled(double right) {
    const double c = std::cos(right), s = std::sin(right);
    return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
}

}  // namespace

std::span<const EyeAxis> eye_axes() { return axes; }

View moved(const View& recorded, const EyeMove& move) {
    View view = recorded;
    if (move == EyeMove{}) return view;
    view.origin += glm::transpose(view.to_view) * glm::dvec3(move.truck, move.pedestal, move.dolly);
    view.to_view = rolled(move.roll) * tilted(move.tilt) * panned(move.pan) * view.to_view;
    return view;
}

EyeMove move_between(const View& recorded, const View& wanted) {
    const glm::dvec3 offset = recorded.to_view * (wanted.origin - recorded.origin);
    // turn = roll tilt pan; its rows are where the wanted view's axes lie in the recorded view.
    const glm::dmat3 turn = wanted.to_view * glm::transpose(recorded.to_view);
    const auto at = [&](int row, int column) { return turn[column][row]; };
    EyeMove move{.dolly = offset.z, .truck = offset.x, .pedestal = offset.y};
    move.tilt = std::asin(std::clamp(at(2, 1), -1.0, 1.0));
    // Straight up or down pan and roll are one turn; nearer than 5e-8 to the right angle the sine no longer tells them apart.
    if (std::abs(at(2, 1)) > 1 - 1e-15) {
        move.pan = std::atan2(-at(0, 2), at(0, 0));
    } else {
        move.pan = std::atan2(at(2, 0), at(2, 2));
        move.roll = std::atan2(-at(0, 1), at(1, 1));
    }
    return move;
}

View orbited(const View& view, const Orbit& orbit) {
    const glm::dmat3 from_view = glm::transpose(view.to_view);
    const glm::dvec3 center = view.origin + orbit.distance * from_view[2];
    // Right is what the view calls right, whatever the world's handedness, and upside down, too.
    const double hand = glm::determinant(from_view) < 0 ? -1 : 1;
    const double upright = hand * glm::dot(glm::cross(orbit.up, from_view[2]), from_view[0]);
    const double side = upright < -1e-12 ? -hand : hand;
    const glm::dmat3 around(glm::rotate(glm::dmat4(1), -side * orbit.right, glm::normalize(orbit.up)));
    const glm::dmat3 over(glm::rotate(glm::dmat4(1), hand * orbit.over, from_view[0]));
    const glm::dmat3 turn = around * over;
    View turned = view;
    turned.origin = center + turn * (view.origin - center);
    turned.to_view = view.to_view * glm::transpose(turn);
    return turned;
}

std::string text(const EyeMove& move) {
    std::string text;
    for (const EyeAxis& axis : axes)
        if (move.*axis.member != 0) text += fmt::format("{}{}={}", text.empty() ? "" : ",", axis.name, move.*axis.member);
    return text;
}

Result<EyeMove> eye_move_of(std::string_view text) {
    EyeMove move;
    std::vector<std::string_view> known;
    for (const EyeAxis& axis : axes) known.push_back(axis.name);
    std::array<bool, std::size(axes)> given{};
    while (!text.empty()) {
        const std::string_view part = text.substr(0, text.find(','));
        text.remove_prefix(std::min(part.size() + 1, text.size()));
        const std::size_t equals = std::min(part.find('='), part.size());
        const std::string_view name = part.substr(0, equals), number = part.substr(std::min(equals + 1, part.size()));
        const auto axis = std::ranges::find(axes, name, &EyeAxis::name);
        if (axis == std::end(axes))
            return fail(Fault::usage, "eye.unknown_axis", "--eye takes {axes}, not '{axis}'{suggestion}",
                        fmt::format("{}", fmt::join(known, ", ")), name, did_you_mean(name, known));
        if (std::exchange(given[static_cast<std::size_t>(axis - axes)], true))
            return fail(Fault::usage, "eye.axis_given_twice", "--eye gives {axis} twice", name);
        double& value = move.*axis->member;
        const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), value);
        if (problem != std::errc() || end != number.data() + number.size() || !std::isfinite(value))
            return fail(Fault::usage, "eye.not_a_number", "--eye: {axis} takes a finite number, not '{value}'", name, number);
    }
    return move;
}

}  // namespace strata
