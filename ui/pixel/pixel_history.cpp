#include "ui/pixel/pixel_history.h"

#include <cmath>
#include <map>

#include "passes/frame_images.h"

namespace strata::ui {
namespace {

/// NaN is the same as NaN: nothing happened to it.
bool is_same(const glm::dvec4& a, const glm::dvec4& b) {
    for (int c = 0; c < 4; ++c)
        if (a[c] != b[c] && !(std::isnan(a[c]) && std::isnan(b[c]))) return false;
    return true;
}

}  // namespace

std::vector<PixelStep> history_of(std::span<const StepImages> steps) {
    std::vector<PixelStep> history;
    std::map<std::string, std::vector<glm::dvec4>> last;
    for (const StepImages& step : steps) {
        PixelStep& made = history.emplace_back(PixelStep{step.step, step.scope, step.name, {}});
        for (const auto& [name, image] : step.images) {
            std::vector<glm::dvec4> now;
            const std::uint32_t layers = image.shape.layers * image.shape.extent.depth;
            for (std::uint32_t layer = 0; layer < layers; ++layer) now.push_back(texel(image, 0, 0, layer));
            const auto before = last.find(name);
            for (std::uint32_t layer = 0; layer < layers; ++layer) {
                Change change = Change::first;
                if (before != last.end() && layer < before->second.size())
                    change = is_same(now[layer], before->second[layer]) ? Change::same : Change::changed;
                made.values.push_back({name, layer, layers, image.shape.format, now[layer], change});
            }
            last[name] = std::move(now);
        }
    }
    return history;
}

std::string text_of(const PixelValue& value, double near) {
    const FormatRow& format = row(value.format);
    std::string text;
    for (std::uint32_t c = 0; c < format.channels; ++c) {
        const double number = value.value[static_cast<int>(c)];
        text += format.kind == FormatKind::integer ? fmt::format("{}{:.0f}", c ? "  " : "", number)
                                                   : fmt::format("{}{:.5g}", c ? "  " : "", number);
    }
    const FrameImageRow* known = find_frame_image(value.image);
    if (!known || known->content != Content::depth) return text;
    return text + (value.value.x > 0 ? fmt::format("  ({:.4g} m)", near / value.value.x) : "  (no surface)");
}

}  // namespace strata::ui
