#include "passes/lighting/material_table.h"

#include "passes/graph/graph.h"
#include "passes/lighting/material_table.shared.h"

namespace strata::lighting {

Image material_table(Graph& graph) {
    const Extent extent{table_width, table_height, table_slices};
    Image table = graph.create("material table",
                               {.extent = {table_width, table_height}, .format = Format::rgba8_unorm, .layers = table_slices});
    graph.compute("lighting/material_table.comp").stores("table", table).over(extent);
    return table;
}

}  // namespace strata::lighting
