#include "replay/cli/table_output.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdlib>

#include <CLI/CLI.hpp>

#include "capture_format/container/whole_file.h"
#include "replay/cli/verb.h"
#include "replay/standard_streams.h"
#include "replay/tables/document.h"

namespace strata {
namespace {

struct Ending {
    std::string_view text;
    OutputFormat format;
};
constexpr std::array endings{Ending{".json", OutputFormat::json},   Ending{".csv", OutputFormat::csv},
                             Ending{".md", OutputFormat::markdown}, Ending{".txt", OutputFormat::text},
                             Ending{".html", OutputFormat::html},   Ending{".svg", OutputFormat::svg}};

/// The format of a file's ending, or null.
const Ending* ending_of(const std::filesystem::path& file) {
    const std::string text = file.extension().string();
    const auto* found = std::ranges::find(endings, text, &Ending::text);
    return found == endings.end() ? nullptr : found;
}

}  // namespace

void add_formats(CLI::App& app, TableOutput& output) {
    CLI::Option* json = app.add_flag("--json", output.json, "print JSON instead of text");
    app.add_flag("--csv", output.csv, "print comma-separated values instead of text")->excludes(json);
}

void add_output_file(CLI::App& app, TableOutput& output, const std::string& help) {
    app.add_option("-o,--output", output.file, help)->type_name(output_file);
}

Result<void> check_ending(const TableOutput& output) {
    if (!output.file.has_extension()) return {};
    const std::string name = output.file.string();
    const Ending* ending = ending_of(output.file);
    const bool is_other = ending && ((ending->format == OutputFormat::html && !output.may_be_page) ||
                                     (ending->format == OutputFormat::svg && !output.may_be_plot));
    if (!ending || is_other)
        return fail(
            Fault::usage, "output.unknown_ending", "cannot write '{file}': its ending must be {endings}", name,
            fmt::format("{}{}.json, .csv, .md or .txt", output.may_be_page ? ".html, " : "", output.may_be_plot ? ".svg, " : ""));
    const bool fits = !(output.json || output.csv) || ending->format == printed_format(output);
    if (!fits)
        return fail(Fault::usage, "output.ending_contradicts", "'{file}' does not end in {ending}, which {option} asks for", name,
                    output.json ? ".json" : ".csv", output.json ? "--json" : "--csv");
    return {};
}

OutputFormat printed_format(const TableOutput& output) {
    return output.json ? OutputFormat::json : output.csv ? OutputFormat::csv : OutputFormat::text;
}

OutputFormat file_format(const TableOutput& output, OutputFormat otherwise) {
    if (const Ending* ending = ending_of(output.file)) return ending->format;
    return output.json || output.csv ? printed_format(output) : otherwise;
}

Result<void> write_text(const TableOutput& output, const std::string& text) {
    if (!output.file.empty()) return write_whole_file(output.file, text);
    write_stdout(text);
    return {};
}

std::string date_of_output() {
    if (const char* fixed = std::getenv("SOURCE_DATE_EPOCH")) {
        const std::string_view text = fixed;
        std::int64_t seconds = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), seconds);
        constexpr std::int64_t last = 253402300799;  // of the year 9999
        if (problem == std::errc() && end == text.data() + text.size() && seconds >= 0 && seconds <= last)
            return utc_date(seconds);
    }
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return utc_date(std::chrono::duration_cast<std::chrono::seconds>(now).count());
}

}  // namespace strata
