// What is stated of a technique, and measured: failures that are known, ratios of times, and the tables that a talk prints.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "passes/stage.h"

namespace strata {

struct Frame;  // capture_format/frame.h

/// A hard case (replay/report/hard_cases.h) that a technique is known not to hold, and by how much: neither more nor less.
struct KnownFailure {
    std::string_view hard_case;
    double error = 0;
    std::string_view because;
};

/// What is changed in a scenario's frame before it is measured.
struct FrameChange {
    std::string_view name = {};  ///< "64 lights"; empty: nothing is changed
    void (*change)(Frame&) = nullptr;
};

/// The condition on which a ratio compares different work: one way counts more than a number.
struct RatioWitness {
    std::string_view counter = {};    ///< of TimeRatio::counters; empty: the work always differs
    std::string_view otherwise = {};  ///< said where it does not happen: "nothing overflowed"
    double more_than = 0;
};

/// How many times as long one way takes as another, as a source states it: `strata bench` measures it. A way is settings of the
/// technique ("slices=64 bits=16"; none: its defaults), or another technique of its stage by name, with its settings.
struct TimeRatio {
    std::string_view name;
    std::string_view of, against;  ///< the ways; the ratio is the time of the one by that of the other
    /// Parts of the names of the technique's steps that count; none: all of them.
    std::vector<std::string_view> steps = {};
    std::optional<double> published = {};
    std::string_view source = {};  ///< of what is published: times, machine, extent
    std::string_view scenario = "particle_storm";
    std::vector<std::string_view> counters = {};  ///< that explain it, of either way
    RatioWitness witness = {};
    /// In place of `steps`: stages of which every step counts, whichever technique it belongs to.
    std::vector<Stage> stages = {};
    /// What differs between the frames of the two ways.
    FrameChange of_frame = {}, against_frame = {};
    bool of_unchanged = false;  ///< the one is timed in a frame that follows itself (Abilities::keeps_work)
};

/// How Strata gets its own number for a column of a published table.
enum class TableValue {
    milliseconds,     ///< of the steps whose names have one of the parts; of a row with `against`, the ratio of times
    megabytes,        ///< 10^6 bytes of the images and buffers whose names have one of the parts
    bits_per_sample,  ///< of the same, by the samples of the frame
    counter,          ///< the first counter of these names that the technique has
    invocations,      ///< of fragment and compute shaders of the stage that the part names
    waves,            ///< per SIMD of the GPU that the part names, by TableRow::group alone
    given,            ///< TableCell::ours: known without running anything
    nothing           ///< nothing counts it: the published number stands alone
};

struct TableValueColumn {
    std::string_view title;
    std::string_view unit = "ms";
    TableValue value = TableValue::milliseconds;
    std::vector<std::string_view> parts = {};  ///< none: everything of the technique
};

/// A number of a published table. What the source does not print is never in `published`.
struct TableCell {
    std::optional<double> published = {};
    std::string_view printed = {};       ///< "> 1.5", where the source prints no plain number
    std::optional<double> derived = {};  ///< by Strata's own arithmetic, see PublishedTable::derivation
    std::optional<double> ours = {};     ///< with TableValue::given
};

/// What a work group takes, for TableValue::waves.
struct GroupNeed {
    std::uint32_t threads = 0, lds_bytes = 0;
};

struct TableRow {
    std::string_view label;
    std::optional<std::string_view> variant = {};       ///< as TimeRatio::of; none: nothing is measured
    std::vector<TableCell> cells = {};                  ///< as the columns
    std::string_view not_measured = "no such variant";  ///< why, where there is no variant
    std::optional<std::string_view> against = {};       ///< the variant by whose times its own are divided
    GroupNeed group = {};
};

/// A table that a source prints, its variants as rows: `strata bench --tables` puts Strata's numbers beside it. Multiples are of
/// the first row.
struct PublishedTable {
    std::string_view title;
    std::string_view source;  ///< who prints it, and of which machine and extent
    std::vector<TableValueColumn> columns;
    std::vector<TableRow> rows;
    std::string_view scenario = "particle_storm";
    std::vector<std::string_view> counters = {};  ///< that explain it
    RatioWitness witness = {};
    std::string_view derivation = {};  ///< how derived numbers come about
    std::string_view note = {};        ///< where the measured steps are not those of the source
};

/// What is stated of a technique, and measured.
struct Claims {
    std::vector<KnownFailure> failures = {};
    std::vector<TimeRatio> ratios = {};
    std::vector<PublishedTable> tables = {};
};

}  // namespace strata
