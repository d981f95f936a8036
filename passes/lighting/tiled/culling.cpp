#include "passes/lighting/tiled/culling.h"

#include <algorithm>

#include "capture_format/frame/light.h"
#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/lighting/tiled/modes.h"
#include "passes/scene/scene_facts.h"
#include "passes/shaders/light_features.shared.h"

namespace strata::lighting {
namespace {

// Below it a tile asks its lights sooner than it reads a list (docs/algorithms/lighting.md 1.5: up to 1k).
constexpr std::size_t lights_worth_a_prefilter = 1024;
// Of all records. 1080p with 4096 lights in every tile would need 343 MB; what does not fit is shaded without a list.
constexpr std::uint64_t most_record_bytes = 64u << 20;

std::uint32_t ceil_divide(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

/// At least one: buffers are sized by it.
std::size_t light_count(const FrameImages& frame) { return std::max<std::size_t>(frame.facts->lights().size(), 1); }

bool is_prefiltered(const FrameImages& frame, const TiledParams& params) {
    if (params.prefilter == prefilter_automatic) return light_count(frame) > lights_worth_a_prefilter;
    return params.prefilter == prefilter_on;
}

std::uint32_t shadow_features(const FrameImages& frame, const TiledParams& params) {
    if (!has_shadows(frame, params)) return 0;
    return params.shadows == shadows_inline ? feature_shadows | feature_soft_shadows : feature_shadows;
}

/// Features that the shader of a tile may be asked for: of shadows what there is, of blockers what pixels test. Light volumes are
/// read by the stage indirect, which has a shader of its own for tiles near blockers.
std::uint32_t shaded_features(const FrameImages& frame, const TiledParams& params) {
    std::uint32_t unused = feature_gi_tap_visibility;
    unused |= (feature_shadows | feature_soft_shadows) & ~shadow_features(frame, params);
    if (params.blockers != blockers_per_pixel) unused |= feature_blockers | feature_portals;
    return every_light_feature & ~unused;
}

/// Every spectrum that cull.comp may write. A tile with lights beyond its records is said to need everything.
std::vector<std::uint32_t> spectra_of_tiles(const FrameImages& frame, const TiledParams& params, const TileMemory& memory) {
    std::vector<std::uint32_t> spectra = frame.facts->possible_spectra(shaded_features(frame, params));
    if (!memory.lists_every_light) spectra.push_back(every_light_feature);
    return spectra;
}

Buffer candidates_of(Graph& graph, const FrameImages& frame, const TiledParams& params, const TileMemory& memory) {
    if (!is_prefiltered(frame, params)) {
        Buffer none = graph.create("tiled candidates", sizeof(std::uint32_t));
        graph.clear(none, 0);
        return none;
    }
    Buffer candidates = graph.create("tiled candidates", memory.candidate_bytes);
    graph.compute("lighting/tiled/macro.comp")
        .stores("Candidates", candidates)
        .groups({ceil_divide(frame.extent.width, macro_size), ceil_divide(frame.extent.height, macro_size), 1});
    return candidates;
}

}  // namespace

bool has_shadows(const FrameImages& frame, const TiledParams& params) {
    return static_cast<bool>(params.shadows == shadows_inline ? frame.shadow_maps : frame.visibility);
}

TileMemory tile_memory(Extent extent, std::size_t lights) {
    const std::uint64_t tiles = std::uint64_t{ceil_divide(extent.width, tile_size)} * ceil_divide(extent.height, tile_size);
    const std::uint64_t macro_tiles =
        std::uint64_t{ceil_divide(extent.width, macro_size)} * ceil_divide(extent.height, macro_size);
    const std::uint64_t listed = std::min<std::uint64_t>(lights, most_listed);
    const std::uint64_t batches = std::max<std::uint64_t>(1, (listed + most_tile_lights - 1) / most_tile_lights);
    const std::uint64_t most = std::max(tiles, most_record_bytes / sizeof(TileRecord));
    const std::uint64_t records = std::min(tiles * batches, most);
    return {.listed_lights = static_cast<std::uint32_t>(listed),
            .spare_records = static_cast<std::uint32_t>(records - tiles),
            .record_bytes = records * sizeof(TileRecord),
            .candidate_bytes = macro_tiles * (listed + 1) * sizeof(std::uint32_t),
            .lists_every_light = lights <= listed && records == tiles * batches};
}

CulledTiles cull_tiles(Graph& graph, const FrameImages& frame, const TiledParams& params) {
    const TileMemory memory = tile_memory(frame.extent, light_count(frame));
    CulledTiles culled{.across = ceil_divide(frame.extent.width, tile_size),
                       .down = ceil_divide(frame.extent.height, tile_size),
                       .order = mode_order(params, spectra_of_tiles(frame, params, memory))};
    culled.records = graph.create("tiled records", memory.record_bytes);
    culled.statistics = graph.create("tiled statistics", culled.count() * sizeof(TileStatistics));
    culled.dispatches = graph.create("tiled dispatches", most_modes * sizeof(ModeDispatch));
    culled.tiles = graph.create("tiled tiles", culled.count() * sizeof(std::uint32_t));
    Buffer used_records = graph.create("tiled used records", sizeof(std::uint32_t));
    graph.clear(used_records, 0);
    const Buffer candidates = candidates_of(graph, frame, params, memory);
    sample_edges(sample_gbuffer(graph.compute("lighting/tiled/cull.comp"), frame), frame)
        .loads("Candidates", candidates)
        .stores("Records", culled.records)
        .updates("UsedRecords", used_records)
        .stores("Statistics", culled.statistics)
        .fixes("half_z", params.half_z)
        .fixes("blocker_use", params.blockers)
        .fixes("classifies", params.classify)
        .fixes("overflow_policy", params.overflow)
        .fixes("is_prefiltered", is_prefiltered(frame, params) ? 1u : 0u)
        .fixes("shadow_features", shadow_features(frame, params))
        .push(CullPush{culled.order, memory.spare_records})
        .groups({culled.across, culled.down, 1});
    graph.compute("lighting/tiled/tiles_by_mode.comp")
        .loads("Records", culled.records)
        .stores("Dispatches", culled.dispatches)
        .stores("Tiles", culled.tiles)
        .fixes("tile_count", culled.count())
        .push(culled.order.count)
        .groups({1, 1, 1});
    return culled;
}

}  // namespace strata::lighting
