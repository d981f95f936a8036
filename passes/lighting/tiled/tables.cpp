#include "passes/lighting/tiled/tables.h"

#include "passes/lighting/tiled/tiled.shared.h"

namespace strata::lighting {

// The slide's 8 waves do not follow from 2 KB per group of four waves: docs/algorithms/lighting.md 1.6 and 1.7.
std::vector<PublishedTable> tiled_published_tables() {
    constexpr double lights = sizeof(TileLists::initial) + sizeof(TileLists::final);
    constexpr double bits = sizeof(TileLists::pairs) + sizeof(TileLists::portals_full) + sizeof(TileLists::portals_part) +
                            sizeof(TileLists::blockers_part);
    constexpr std::uint32_t places = tile_threads / 8;  // a bit per thread for places in order
    constexpr std::uint32_t total = sizeof(TileLists) + places;
    constexpr double of_a_simd = 65536. / 4;
    return {
        {.title = "LDS and waves of culling",
         .source = "Kircher's talk, bonus slide: PS4",
         .columns = {{.title = "lists of lights", .unit = "bytes", .value = TableValue::given},
                     {.title = "bit arrays", .unit = "bytes", .value = TableValue::given},
                     {.title = "LDS", .unit = "bytes", .value = TableValue::given},
                     {.title = "waves per SIMD", .unit = "", .value = TableValue::waves, .parts = {"ps4"}}},
         .rows = {{.label = "a tile of 256 threads",
                   .variant = "",
                   .cells = {{.published = 512, .ours = lights},
                             {.published = 1280, .ours = bits},
                             {.printed = "~ 2 KB", .derived = 512 + 1280, .ours = total},
                             {.published = 8, .derived = of_a_simd / 2048}},
                   .group = {.threads = tile_threads, .lds_bytes = total}}},
         .scenario = "agents_hq",
         .counters = {"lights touching", "lights kept", "blocker tests"},
         .derivation = "LDS: sum of the printed parts, without counts; waves: the slide's 8 if 2 KB are charged to each wave, "
                       "16 KiB of a SIMD by 2 KiB",
         .note = "waves as LDS alone limits them, four waves sharing a tile's; registers allow fewer: strata isa prints them"}};
}

}  // namespace strata::lighting
