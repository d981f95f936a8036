#include "replay/session/light_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "passes/frame_images.h"
#include "replay/plural.h"
#include "replay/session/light_unit.h"

namespace strata {
namespace {

constexpr double largest_half = 65504;

bool is_half(Format format) { return format == Format::r16f || format == Format::rg16f || format == Format::rgba16f; }

}  // namespace

bool holds_light(std::string_view name) {
    const FrameImageRow* row = find_frame_image(name);
    return row && (row->content == Content::radiance || row->content == Content::display);
}

std::vector<LightFault> light_faults(std::string_view name, const HostImage& image, double pre_exposure) {
    if (!holds_light(name)) return {};
    return light_faults(name, image.shape.format, in_double(image), pre_exposure);
}

std::vector<LightFault> light_faults(std::string_view name, Format format, const ReferenceImage& image, double pre_exposure) {
    if (!holds_light(name)) return {};
    LightFault not_finite{.kind = LightFault::Kind::not_finite, .image = std::string(name)};
    LightFault cut_off{.kind = LightFault::Kind::cut_off, .image = std::string(name)};
    cut_off.limit = largest_half / (holds_radiance(name) ? pre_exposure : 1);
    const bool has_limit = is_half(format);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        const glm::dvec3 light(image.texels[i]);
        const double largest = std::max({std::abs(light.x), std::abs(light.y), std::abs(light.z)});
        const bool is_finite = std::isfinite(light.x) && std::isfinite(light.y) && std::isfinite(light.z);
        if (is_finite && !(has_limit && largest >= largest_half)) continue;
        LightFault& fault = is_finite ? cut_off : not_finite;
        if (fault.texels++ == 0) fault.first = {i % image.width, i / image.width % image.height};
    }
    std::vector<LightFault> faults;
    for (LightFault* fault : {&not_finite, &cut_off})
        if (fault->texels > 0) faults.push_back(std::move(*fault));
    return faults;
}

std::string sentence(const LightFault& fault) {
    const bool is_picture = fault.image == "display";
    const std::string texels = plural(fault.texels, is_picture ? "pixel" : "sample");
    const std::string where = fmt::format("after {}, first at {}, {}", fault.pass, fault.first.x, fault.first.y);
    const std::string_view are = fault.texels == 1 ? "is" : "are";
    if (fault.kind == LightFault::Kind::not_finite)
        return fmt::format("{} of '{}' {} not finite {}", texels, fault.image, are, where);
    return fmt::format("{} of '{}' {} cut off at {:.4g}, the most that its half floats hold, {}", texels, fault.image, are,
                       fault.limit, where);
}

}  // namespace strata
