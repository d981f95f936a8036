// Draws restricted to rows of their attachments: what the plan says of them and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/graph/describe.h"
#include "passes/graph/graph.h"
#include "tests/2_graph/small_graphs.h"

namespace strata {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// 64 x 32 pixels, drawn in parts.
struct DrawnInRows {
    DrawnInRows() {
        graph.clear(color, {});
        graph.keep(color);
    }
    void draw(Rows rows) { graph.draw("paint", list).covers(color).in_rows(rows); }
    void draw_columns(PixelColumns columns) { graph.draw("paint", list).covers(color).in_rows({6, 12}).in_columns(columns); }

    Graph graph;
    Image color = graph.create("color", small_shape());
    DrawList list{graph.import("commands", 20, ImportId{1}), graph.import("indices", 12, ImportId{2}), 0, 1};
};

TEST(DrawsInRows, AreSaidToBeSoInThePlansText) {
    DrawnInRows f;
    f.draw({6, 12});
    EXPECT_THAT(describe(compiled(f.graph)), HasSubstr("    paint, rows 6 to 17\n"));
}

TEST(DrawsInRows, KeepWhatWasDrawnIntoOtherRows) {
    DrawnInRows f;
    f.draw({0, 16});
    f.draw({16, 16});
    EXPECT_THAT(step_names(compiled(f.graph)), ElementsAre("clear color", "paint", "paint"));
}

TEST(DrawsInRows, ReachTheLastRowAndNoFurther) {
    DrawnInRows last, beyond;
    last.draw({31, 1});
    EXPECT_EQ(compiled(last.graph).steps.size(), 2u);
    beyond.draw({31, 2});
    EXPECT_THAT(refusal(beyond.graph), FailsWith("graph.rows_out_of_range", Field("step", "paint"), Field("rows", 2),
                                                 Field("first", 31), Field("height", 32)));
}

TEST(DrawsInRows, HaveAtLeastOneRow) {
    DrawnInRows f;
    f.draw({8, 0});
    EXPECT_THAT(refusal(f.graph), FailsWith("graph.rows_out_of_range", Field("step", "paint"), Field("rows", 0),
                                            Field("first", 8), Field("height", 32)));
}

TEST(DrawsInColumns, AreSaidAndKeptWithin) {
    DrawnInRows f, beyond, none;
    f.draw_columns({32, 32});
    EXPECT_THAT(describe(compiled(f.graph)), HasSubstr("    paint, columns 32 to 63, rows 6 to 17\n"));
    beyond.draw_columns({33, 32});
    EXPECT_THAT(refusal(beyond.graph), FailsWith("graph.columns_out_of_range", Field("step", "paint"), Field("columns", 32),
                                                 Field("first", 33), Field("width", 64)));
    none.draw_columns({3, 0});
    EXPECT_THAT(refusal(none.graph), FailsWith("graph.columns_out_of_range", Field("step", "paint"), Field("columns", 0),
                                               Field("first", 3), Field("width", 64)));
}

}  // namespace
}  // namespace strata
