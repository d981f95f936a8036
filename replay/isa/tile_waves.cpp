#include "replay/isa/tile_waves.h"

#include <algorithm>
#include <cassert>

#include "passes/frame_images.h"
#include "passes/technique.h"
#include "replay/isa/isa_report.h"
#include "replay/session/ability.h"

namespace strata {
namespace {

bool has_variants(const Technique& technique) { return technique.abilities.variants.has_value(); }

std::string name_of(const Technique& technique, std::string_view inside) { return fmt::format("{}:{}", technique.name, inside); }

/// The column's number of a row.
std::uint64_t at(const NumberTable& table, const std::vector<double>& row, std::string_view column) {
    const auto found = std::ranges::find(table.columns, column, &TableColumn::name);
    assert(found != table.columns.end());
    return static_cast<std::uint64_t>(row[static_cast<std::size_t>(found - table.columns.begin())]);
}

/// What the compiler made of a variant; null where its pipeline is none of the technique's.
const IsaProgram* program_of(const TilesAndCode& joined, std::uint32_t number) {
    const auto holds_number = [&](const Fixed& fixed) {
        return fixed.name == joined.technique.abilities.variants->constant && fixed.value == SpecValue(number);
    };
    for (const IsaStep& isa_step : joined.gpu.steps) {
        const std::vector<Fixed>& fixed = joined.requests.pipelines[isa_step.pipeline].step.step.fixed;
        if (!is_pass_of(isa_step.scope, joined.technique.name) || std::ranges::none_of(fixed, holds_number)) continue;
        const auto program = std::ranges::find(joined.gpu.programs, isa_step.pipeline, &IsaProgram::pipeline);
        if (program != joined.gpu.programs.end()) return &*program;
    }
    return nullptr;
}

HostImage waves_of_pixels(const HostImage& numbers, std::span<const VariantWaves> variants) {
    HostImage picture{{.extent = numbers.shape.extent, .format = Format::r32f}, {}};
    for (std::uint32_t y = 0; y < numbers.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < numbers.shape.extent.width; ++x) {
            const double number = texel(numbers, x, y).x;
            const auto variant =
                std::ranges::find_if(variants, [&](const VariantWaves& one) { return double(one.number) == number; });
            const float waves = variant == variants.end() ? 0 : static_cast<float>(variant->occupancy.waves_per_simd);
            const auto bytes = std::as_bytes(std::span(&waves, 1));
            picture.texels.insert(picture.texels.end(), bytes.begin(), bytes.end());
        }
    return picture;
}

}  // namespace

Result<const Technique*> technique_of_variants(const ChoiceChanges& choices) {
    return technique_with({has_variants, "has no shading modes"}, choices);
}

std::vector<std::string> outputs_of_variants(const Technique& technique) {
    return {name_of(technique, technique.abilities.variants->view), name_of(technique, technique.abilities.variants->table)};
}

Result<TileWaves> waves_of_tiles(const TilesAndCode& joined) {
    const Technique& technique = joined.technique;
    const auto skipped = std::ranges::find(joined.run.skipped, technique.stage, &SkippedStage::stage);
    if (skipped != joined.run.skipped.end())
        return fail(Fault::usage, "isa.no_shaded_tile", "{technique} shades no tile: {reason}", technique.name, skipped->reason);
    const NumberTable& table = joined.run.tables.at(name_of(technique, technique.abilities.variants->table));
    TileWaves made{.technique = std::string(technique.name),
                   .constant = std::string(technique.abilities.variants->constant),
                   .columns = table.columns};
    for (const std::vector<double>& row : table.rows) {
        const auto number = static_cast<std::uint32_t>(at(table, row, technique.abilities.variants->constant));
        const IsaProgram* program = program_of(joined, number);
        if (!program || !program->occupancy)
            return fail(Fault::device_lacks, "isa.no_occupancy",
                        "{gpu} does not tell how many waves of {constant} {variant} fit a SIMD", joined.gpu.name,
                        technique.abilities.variants->constant, number);
        made.variants.push_back({row, number, at(table, row, "tiles"), program->registers, *program->occupancy});
        made.tiles += made.variants.back().tiles;
        made.mean += double(made.variants.back().tiles) * program->occupancy->waves_per_simd;
    }
    if (made.tiles == 0)
        return fail(Fault::usage, "isa.no_shaded_tile", "{technique} shades no tile: {reason}", technique.name,
                    "nothing opaque is in view");
    made.mean /= double(made.tiles);
    made.picture = waves_of_pixels(joined.run.images.at(name_of(technique, technique.abilities.variants->view)), made.variants);
    return made;
}

}  // namespace strata
