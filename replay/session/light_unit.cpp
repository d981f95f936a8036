#include "replay/session/light_unit.h"

#include <algorithm>
#include <cstring>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/session/session.h"

namespace strata {

bool holds_radiance(std::string_view name) {
    if (const FrameImageRow* row = find_frame_image(name)) return row->content == Content::radiance;
    const std::size_t colon = name.find(':');
    if (colon == std::string_view::npos) return false;
    const Result<const Technique*> technique = find_technique(name.substr(0, colon));
    if (!technique) return false;
    const std::vector<DebugView>& views = (*technique)->views;
    const auto view = std::ranges::find(views, name.substr(colon + 1), &DebugView::name);
    return view != views.end() && view->unit.starts_with("W/");
}

HostImage scaled_light(std::string_view name, HostImage image, double factor) {
    if (factor == 1 || !holds_radiance(name)) return image;
    const ReferenceImage stored = in_double(image);
    std::vector<glm::vec4> texels(stored.texels.size());
    std::ranges::transform(stored.texels, texels.begin(),
                           [&](const glm::dvec4& texel) { return glm::vec4(glm::dvec3(texel) * factor, texel.w); });
    image.shape.format = Format::rgba32f;
    image.texels.resize(texels.size() * sizeof(glm::vec4));
    std::memcpy(image.texels.data(), texels.data(), image.texels.size());
    return image;
}

void scale_light(NumberTable& table, double factor) {
    if (factor == 1) return;
    for (std::size_t column = 0; column < table.columns.size(); ++column)
        if (table.columns[column].unit == "W")
            for (std::vector<double>& row : table.rows) row[column] *= factor;
}

void scale_light(ImageSet& images, double factor) {
    if (factor == 1) return;
    for (auto& [name, image] : images) {
        if (!holds_radiance(name)) continue;
        const auto scale = [factor](glm::dvec4& texel) { texel = glm::dvec4(glm::dvec3(texel) * factor, texel.w); };
        std::ranges::for_each(image.texels, scale);
        std::ranges::for_each(image.alternatives, scale, &Alternative::value);
        for (glm::dvec3& error : image.standard_error) error *= factor;
    }
}

const ImageSet& in_unit(double factor, const ImageSet& images, ImageSet& room) {
    if (factor == 1) return images;
    room = images;
    scale_light(room, factor);
    return room;
}

}  // namespace strata
