// How a verb that prints a table writes it: --json, --csv, and -o FILE by the file's ending.
#pragma once

#include <filesystem>
#include <string>

#include "capture_format/result.h"
#include "replay/tables/sheet.h"

namespace CLI {
class App;
}  // namespace CLI

namespace strata {

enum class OutputFormat { text, json, csv, markdown, html, svg };

struct TableOutput {
    bool json = false, csv = false;
    std::filesystem::path file;  ///< empty: none
    bool may_be_page = false;    ///< the verb makes pages, too: .html
    bool may_be_plot = false;    ///< and plots: .svg
};

/// --json and --csv.
void add_formats(CLI::App&, TableOutput&);
/// -o FILE. To be called after add_formats().
void add_output_file(CLI::App&, TableOutput&, const std::string& help);

/// Refuses a file whose ending is no format or another one than --json or --csv ask for: before anything is measured. A name
/// without an ending (/dev/stdout) fits every format.
Result<void> check_ending(const TableOutput&);
OutputFormat printed_format(const TableOutput&);
/// By the ending; without one what --json or --csv ask for, else `otherwise`.
OutputFormat file_format(const TableOutput&, OutputFormat otherwise);

/// Writes to the file, or to standard output where none was asked for.
Result<void> write_text(const TableOutput&, const std::string& text);

/// The date of what is written, utc_date(): now, or what the environment's SOURCE_DATE_EPOCH says (seconds since 1970).
std::string date_of_output();

/// Not of pages and plots, which a verb makes itself.
template <typename Made>
std::string in_format(OutputFormat format, const Made& made) {
    switch (format) {
        case OutputFormat::text:
        case OutputFormat::html:
        case OutputFormat::svg:
            break;
        case OutputFormat::json:
            return as_json(made);
        case OutputFormat::csv:
            return as_csv(made);
        case OutputFormat::markdown:
            return as_markdown(page_of(made));
    }
    return as_text(made);
}

}  // namespace strata
