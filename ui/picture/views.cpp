#include "ui/picture/views.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

#include "passes/frame_images.h"
#include "passes/technique.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr std::uint32_t thumbnail_width = 160;

/// Whether the text has the word, between characters that are no part of one.
bool has_word(std::string_view text, std::string_view word) {
    const auto is_of_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !is_of_word(text[at - 1])) && (end == text.size() || !is_of_word(text[end]))) return true;
    }
    return false;
}

bool has_column(const Technique& technique, std::string_view name) {
    return std::ranges::any_of(technique.tables, [&](const DebugTable& table) {
        return std::ranges::find(table.columns, name, &TableColumn::name) != table.columns.end();
    });
}

PixelNumbers numbers_of(const HostImage& image, std::string_view column) {
    const Extent& extent = image.shape.extent;
    PixelNumbers made{std::string(column), extent.width, extent.height, {}};
    made.numbers.reserve(std::size_t{extent.width} * extent.height);
    for (std::uint32_t y = 0; y < extent.height; ++y)
        for (std::uint32_t x = 0; x < extent.width; ++x) made.numbers.push_back(static_cast<float>(texel(image, x, y).x));
    return made;
}

/// The mean of the finite texels of a block; NaN where none is.
glm::dvec4 mean_of(const HostImage& image, glm::uvec2 from, glm::uvec2 to) {
    glm::dvec4 sum(0);
    int count = 0;
    for (std::uint32_t y = from.y; y < to.y; ++y)
        for (std::uint32_t x = from.x; x < to.x; ++x) {
            const glm::dvec4 value = texel(image, x, y);
            if (!std::isfinite(value.x + value.y + value.z)) continue;
            sum += value;
            ++count;
        }
    return sum / static_cast<double>(count);
}

}  // namespace

std::string output_name(const Technique& technique, std::string_view inside) {
    return fmt::format("{}:{}", technique.name, inside);
}

std::optional<double> PixelNumbers::at(glm::ivec2 pixel) const {
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= static_cast<int>(width) || pixel.y >= static_cast<int>(height)) return {};
    const float number = numbers[static_cast<std::size_t>(pixel.y) * width + static_cast<std::size_t>(pixel.x)];
    return number >= 0 ? std::optional(double{number}) : std::nullopt;
}

Result<TechniqueViews> views_of(Session& session, Request request, const Technique& technique) {
    request.outputs.clear();
    for (const DebugView& view : technique.views) request.outputs.push_back(output_name(technique, view.name));
    for (const DebugTable& table : technique.tables) request.outputs.push_back(output_name(technique, table.name));
    auto run = session.run(request);
    if (!run) return run.error();
    TechniqueViews made;
    for (const DebugView& view : technique.views)
        if (const auto image = run->images.find(output_name(technique, view.name)); image != run->images.end())
            made.thumbnails[std::string(view.name)] = thumbnail(image->second, thumbnail_width);
    for (const DebugTable& table : technique.tables)
        if (const auto numbers = run->tables.find(output_name(technique, table.name)); numbers != run->tables.end())
            made.tables[std::string(table.name)] = std::move(numbers->second);
    for (const auto& [view, column] : numbering_views(technique))
        if (const auto image = run->images.find(output_name(technique, view)); image != run->images.end())
            made.numbers.push_back(numbers_of(image->second, column));
    return made;
}

Texels thumbnail(const HostImage& image, std::uint32_t most_width) {
    const Extent& extent = image.shape.extent;
    const std::uint32_t width = std::min(extent.width, most_width);
    const std::uint32_t height = std::max(1u, (extent.height * width + extent.width / 2) / extent.width);
    Texels made{width, height, {}};
    made.rgba.reserve(std::size_t{4} * width * height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const glm::uvec2 from(x * extent.width / width, y * extent.height / height);
            const glm::uvec2 to((x + 1) * extent.width / width, (y + 1) * extent.height / height);
            const glm::dvec4 mean = mean_of(image, from, glm::max(to, from + 1u));
            for (int c = 0; c < 4; ++c) made.rgba.push_back(static_cast<float>(mean[c]));
        }
    return made;
}

std::vector<std::pair<std::string_view, std::string_view>> numbering_views(const Technique& technique) {
    std::vector<std::pair<std::string_view, std::string_view>> found;
    for (const DebugView& view : technique.views)
        if (has_column(technique, view.name)) found.emplace_back(view.name, view.name);
    if (technique.abilities.variants)
        found.emplace_back(technique.abilities.variants->view, technique.abilities.variants->constant);
    return found;
}

std::vector<PixelRow> rows_of_pixel(const TechniqueViews& views, glm::ivec2 pixel) {
    std::vector<PixelRow> found;
    for (const auto& [name, table] : views.tables)
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            const auto numbers = std::ranges::find(views.numbers, table.columns[c].name, &PixelNumbers::column);
            if (numbers == views.numbers.end()) continue;
            const auto number = numbers->at(pixel);
            for (std::size_t r = 0; number && r < table.rows.size(); ++r)
                if (table.rows[r][c] == *number) found.push_back({name, &table, r});
            break;
        }
    return found;
}

std::vector<PlotSeries> curves_of(const NumberTable& table) {
    std::vector<PlotSeries> curves;
    for (std::size_t c = 1; c < table.columns.size(); ++c) {
        PlotSeries curve{.label = std::string(table.columns[c].name), .points = {}, .color = color_of_stage(c)};
        for (const std::vector<double>& row : table.rows) curve.points.emplace_back(row[0], row[c]);
        curves.push_back(std::move(curve));
    }
    return curves;
}

bool counts_overflow(const Counter& counter) {
    constexpr std::string_view signs[] = {"overflow", "too late", "no place", "unlisted"};
    const auto says = [&](std::string_view sign) {
        return counter.name.find(sign) != counter.name.npos || counter.help.find(sign) != counter.help.npos;
    };
    return has_word(counter.name, "over") || std::ranges::any_of(signs, says);
}

std::string cell_text(const TableColumn& column, double value) {
    if (column.unit == "bits" && value >= 0) return fmt::format("0x{:x}", static_cast<std::uint64_t>(value));
    if (value == std::round(value)) return fmt::format("{:.0f}", value);
    return fmt::format("{:.5g}", value);
}

HostImage slice_of(const HostImage& image, double at, double half) {
    HostImage made = image;
    const Extent& extent = image.shape.extent;
    const std::uint32_t layers = image.shape.layers * extent.depth;
    const std::size_t bytes = image.texels.size() / (std::size_t{extent.width} * extent.height * layers);
    for (std::uint32_t layer = 0; layer < layers; ++layer)
        for (std::uint32_t y = 0; y < extent.height; ++y)
            for (std::uint32_t x = 0; x < extent.width; ++x) {
                if (std::abs(texel(image, x, y, layer).x - at) <= half) continue;
                const std::size_t place = (std::size_t{layer} * extent.height + y) * extent.width + x;
                std::memset(made.texels.data() + place * bytes, 0, bytes);
            }
    return made;
}

}  // namespace strata::ui
