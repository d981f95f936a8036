// Tables that talks print (Claims::tables), measured: every variant of a table within one run, and Strata's number beside each
// published one.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "replay/session/session.h"
#include "replay/tables/cell.h"
#include "replay/tables/sheet.h"

namespace strata {

struct PublishedTable;  // passes/claims.h
struct TableCell;       // passes/claims.h
struct Technique;       // passes/technique.h

/// A table, and what it is measured on.
struct TableClaim {
    const Technique* technique = nullptr;
    const PublishedTable* table = nullptr;
    Request base;       ///< frame, other stages' choices
    std::string scene;  ///< for people: the scenario's or the capture's name
};

/// A cell of the table. Multiples are of the first row's cell in the same column; nothing where that has no number.
struct MeasuredTableCell {
    std::string row, column, unit;
    const TableCell* stated = nullptr;
    CellValue measured = {}, multiple = {};  ///< times with their spread
    std::optional<double> published_multiple = {};
    std::string not_measured = {};  ///< why there is no measured number
};

/// A row's variant: what it is, holds and counts.
struct MeasuredTableRow {
    std::string row, variant, against;
    std::uint64_t stage_bytes = 0;  ///< images and buffers first used by the technique
    std::vector<CounterRecord> counters = {};
};

struct MeasuredTable {
    TableClaim claim;
    std::uint32_t width = 0, height = 0, samples = 0;  ///< 0: nothing was run
    std::vector<MeasuredTableCell> cells;              ///< column by column
    std::vector<MeasuredTableRow> rows;                ///< those that ran
    bool is_witnessed = true;                          ///< the table's witness happened, or it asks for none
};

struct PublishedTables {
    DeviceInfo device;
    std::size_t repeats = 0;
    std::vector<MeasuredTable> tables;  ///< as the claims
    std::string stopped = {};           ///< what is missing because a stop was asked for
    std::string date = {};              ///< utc_date(); the caller's
};

/// Rows that cannot run on the frame say why. Stopped (Session::stop_when), it gives the tables that are complete, or fails where
/// there is none.
Result<PublishedTables> measure_tables(Session&, std::span<const TableClaim>, std::size_t repeats, const Progress& = {});

Sheet sheet_of(const MeasuredTable&);
/// Each table, then why cells have no number, and what each variant held and counted.
Page page_of(const PublishedTables&);
std::string as_text(const PublishedTables&);
std::string as_json(const PublishedTables&);
std::string as_csv(const PublishedTables&);

}  // namespace strata
