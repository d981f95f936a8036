#include "ui/pixel/pixel_inside.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/frame_images.h"
#include "passes/technique.h"

namespace strata::ui {
namespace {

std::string number_text(double value) {
    return value == std::floor(value) && std::abs(value) < 1e9 ? fmt::format("{:.0f}", value) : fmt::format("{:.5g}", value);
}

std::string mask_text(double value) {
    return value < 0 ? number_text(value) : fmt::format("{:#06x}", static_cast<std::uint32_t>(value));
}

bool is_mask(const TableColumn& column) { return column.unit == "bits"; }

std::optional<std::size_t> column_of(const DebugTable& table, std::string_view name) {
    const auto found = std::ranges::find(table.columns, name, &TableColumn::name);
    if (found == table.columns.end()) return {};
    return static_cast<std::size_t>(found - table.columns.begin());
}

/// Which rows of a table are about the pixel.
struct Key {
    std::size_t column = 0;
    double value = 0;
};

std::optional<Key> key_of(const Technique& technique, const DebugTable& table, const std::vector<InsideValue>& values,
                          std::uint32_t tile) {
    if (const auto column = column_of(table, "tile"); column && table.tile > 0) return Key{*column, static_cast<double>(tile)};
    for (const DebugView& view : technique.views) {
        const auto column = key_column(technique, table, view);
        const auto value = std::ranges::find(values, view.name, &InsideValue::view);
        if (column && value != values.end()) return Key{*column, value->value.x};
    }
    return {};
}

InsideRows rows_of(const DebugTable& table, const NumberTable& numbers, const Key& key) {
    InsideRows made{.table = &table};
    const TableColumn& column = table.columns[key.column];
    const auto text = [&](double value) { return is_mask(column) ? mask_text(value) : number_text(value); };
    made.why = fmt::format("{} {}", column.name, text(key.value));
    double last = -1;
    for (const std::vector<double>& row : numbers.rows) {
        last = std::max(last, row[key.column]);
        if (row[key.column] == key.value) made.rows.push_back(row);
    }
    if (!made.rows.empty()) return made;
    if (numbers.rows.empty()) made.none = "the table is empty";
    else if (last < key.value) made.none = fmt::format("no row: the table's last is of {} {}", column.name, text(last));
    else made.none = "no row";
    return made;
}

/// The one output of a request; nothing where the frame lacks it.
Result<Run> run_for(Session& session, Request request, std::string output) {
    request.outputs = {std::move(output)};
    return session.run(request);
}

Result<void> read_views(Session& session, Progress& progress, const InsideQuestion& question, PixelInside& inside) {
    const std::span<const DebugView> views = question.technique->views;
    const auto count = static_cast<double>(views.size() + question.technique->tables.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::string output = fmt::format("{}:{}", question.technique->name, views[i].name);
        if (!progress.at(static_cast<double>(i) / count, output)) return fail(Fault::stopped, "session.stopped", "stopped");
        const auto run = run_for(session, question.request, output);
        if (!run) return run.error();
        if (question.pixel.x >= run->width || question.pixel.y >= run->height)
            return fail(Fault::usage, "frame.no_pixel", "the frame is {width} x {height}; there is no pixel {x}, {y}", run->width,
                        run->height, question.pixel.x, question.pixel.y);
        const auto image = run->images.find(output);
        if (image == run->images.end()) continue;
        const glm::dvec4 value = texel(image->second, question.pixel.x, question.pixel.y);
        const bool mask = std::ranges::any_of(question.technique->tables, [&](const DebugTable& table) {
            const auto column = key_column(*question.technique, table, views[i]);
            return column && is_mask(table.columns[*column]);
        });
        inside.values.push_back({views[i].name, views[i].unit, views[i].help, value, mask});
    }
    return {};
}

Result<void> read_tables(Session& session, Progress& progress, const InsideQuestion& question, PixelInside& inside) {
    const Technique& technique = *question.technique;
    const auto frame = session.frame(question.request.variant.frame);
    if (!frame) return frame.error();
    const auto count = static_cast<double>(technique.views.size() + technique.tables.size());
    for (std::size_t i = 0; i < technique.tables.size(); ++i) {
        const DebugTable& table = technique.tables[i];
        const std::uint32_t tile = table.tile > 0 ? tile_at(question.pixel, frame->view.width, table.tile) : 0;
        const auto key = key_of(technique, table, inside.values, tile);
        if (!key) continue;
        const std::string output = fmt::format("{}:{}", technique.name, table.name);
        if (!progress.at(static_cast<double>(technique.views.size() + i) / count, output))
            return fail(Fault::stopped, "session.stopped", "stopped");
        const auto run = run_for(session, question.request, output);
        if (!run) return run.error();
        const auto numbers = run->tables.find(output);
        if (numbers == run->tables.end()) continue;
        inside.tables.push_back(rows_of(table, numbers->second, *key));
        const auto light = column_of(table, "light");
        for (const std::vector<double>& row : inside.tables.back().rows) {
            if (!light || row[*light] < 0 || row[*light] >= static_cast<double>(frame->lights.size())) continue;
            const auto index = static_cast<std::size_t>(row[*light]);
            inside.lights.resize(std::max(inside.lights.size(), index + 1));
            inside.lights[index] = frame->lights[index].name;
        }
    }
    return {};
}

}  // namespace

std::uint32_t tile_at(glm::uvec2 pixel, std::uint32_t width, std::uint32_t tile_pixels) {
    const std::uint32_t across = (width + tile_pixels - 1) / tile_pixels;
    return pixel.y / tile_pixels * across + pixel.x / tile_pixels;
}

std::optional<std::size_t> key_column(const Technique& technique, const DebugTable& table, const DebugView& view) {
    if (technique.abilities.variants && view.name == technique.abilities.variants->view &&
        table.name == technique.abilities.variants->table)
        return column_of(table, technique.abilities.variants->constant);
    if (!table.columns.empty() && table.columns.front().name == view.name) return 0;
    return {};
}

std::string text_of(const PixelInside& inside, const TableColumn& column, double value) {
    if (is_mask(column)) return mask_text(value);
    std::string text = number_text(value);
    if (column.name == "light" && value >= 0 && value < static_cast<double>(inside.lights.size()))
        if (const std::string& name = inside.lights[static_cast<std::size_t>(value)]; !name.empty())
            text += fmt::format(" '{}'", name);
    return column.unit.empty() ? text : fmt::format("{} {}", text, column.unit);
}

std::string text_of(const InsideValue& inside) {
    const glm::dvec4& v = inside.value;
    if (inside.is_mask) return mask_text(v.x);
    std::string text = number_text(v.x);
    if (v.x != v.y || v.y != v.z) text += fmt::format("  {}  {}", number_text(v.y), number_text(v.z));
    return inside.unit.empty() ? text : fmt::format("{} {}", text, inside.unit);
}

Result<PixelInside> inside_of(Session& session, Progress& progress, const InsideQuestion& question) {
    PixelInside inside;
    if (const auto read = read_views(session, progress, question, inside); !read) return read.error();
    if (const auto read = read_tables(session, progress, question, inside); !read) return read.error();
    return inside;
}

}  // namespace strata::ui
