#include "replay/compare/stored_report.h"

#include <optional>
#include <set>

#include <nlohmann/json.hpp>

#include "capture_format/container/file.h"
#include "passes/metric.h"
#include "replay/report/report.h"
#include "replay/report/variants.h"

namespace strata {
namespace {

using nlohmann::json;

/// Reads keys and keeps the first error; after one it gives empty values.
class KeyReader {
public:
    KeyReader(const json& object, std::string file, std::string where = "")
        : object_(object), file_(std::move(file)), where_(std::move(where)) {}

    const std::optional<Error>& error() const { return error_; }
    void refuse(Error error) {
        if (!error_) error_ = std::move(error);
    }

    bool has(const char* key) const { return object_.contains(key); }

    const json& at(const char* key, bool (json::*is)() const noexcept, const char* wanted) {
        static const json nothing;
        const auto found = object_.is_object() ? object_.find(key) : object_.end();
        if (found == object_.end() || !object_.is_object())
            refuse(fail(Fault::bad_input, "compare.missing_key", "{file} lacks the key '{key}'", file_, where_ + key));
        else if (!((*found).*is)()) refuse_value(key, wanted);
        else return *found;
        return nothing;
    }
    std::string text(const char* key) {
        const json& value = at(key, &json::is_string, "text");
        return value.is_string() ? value.get<std::string>() : "";
    }
    std::uint64_t count(const char* key) {
        const json& value = at(key, &json::is_number_unsigned, "a whole number of 0 or more");
        return value.is_number_unsigned() ? value.get<std::uint64_t>() : 0;
    }
    double number(const char* key) {
        const json& value = at(key, &json::is_number, "a number");
        return value.is_number() ? checked(key, value, 0) : 0;
    }
    /// At least one, none below `least`.
    std::vector<double> numbers(const char* key, double least) {
        std::vector<double> all;
        const json& values = at(key, &json::is_array, "a list of numbers");
        if (values.is_array() && values.empty()) refuse_value(key, "a list of numbers");
        for (const json& value : values) {
            if (!value.is_number()) refuse_value(key, "a list of numbers");
            all.push_back(value.is_number() ? checked(key, value, least) : 0);
        }
        return all;
    }
    void refuse_value(const std::string& key, const char* wanted) {
        refuse(
            fail(Fault::bad_input, "compare.wrong_value", "key '{key}' of {file} must be {wanted}", where_ + key, file_, wanted));
    }

private:
    /// JSON has numbers above the largest double, which the parser refuses, but neither NaN nor infinities.
    double checked(const char* key, const json& value, double least) {
        const auto number = value.get<double>();
        if (number < least) refuse_value(key, least > 0 ? "above 0" : "0 or more");
        return number;
    }

    const json& object_;
    std::string file_, where_;
    std::optional<Error> error_;
};

/// The document is a report of one capture that this program can read.
std::optional<Error> wrong_document(const json& document, const std::string& file) {
    const auto schema = document.is_object() ? document.find("schema") : document.end();
    if (!document.is_object() || schema == document.end() || !schema->is_string())
        return fail(Fault::bad_input, "compare.no_schema", "{file} is JSON, but no report: it has no 'schema'", file);
    const auto name = schema->get<std::string>();
    if (name == pooled_reports_schema)
        return fail(Fault::bad_input, "compare.several_captures",
                    "{file} has several reports; write one file for each with strata report CAPTURE --frames N -o FILE.json",
                    file);
    if (name != report_schema)
        return fail(Fault::bad_input, "compare.other_schema", "{file} is a document of schema '{schema}', not '{wanted}'", file,
                    name, report_schema);
    KeyReader keys(document, file);
    const std::uint64_t version = keys.count("schema_version");
    if (keys.error()) return keys.error();
    if (version > std::uint64_t{report_schema_version})
        return fail(
            Fault::bad_input, "compare.newer_schema",
            "{file} has version {version} of the schema, and this program reads up to {known}; use the program that wrote it",
            file, version, report_schema_version);
    return {};
}

struct Extent {
    std::uint64_t width = 0, height = 0;
};

Extent extent_of(KeyReader& keys) {
    const json& extent = keys.at("extent", &json::is_array, "two whole numbers");
    const bool is_extent =
        extent.is_array() && extent.size() == 2 && extent[0].is_number_unsigned() && extent[1].is_number_unsigned();
    if (!is_extent) {
        keys.refuse_value("extent", "two whole numbers");
        return {};
    }
    return {extent[0].get<std::uint64_t>(), extent[1].get<std::uint64_t>()};
}

/// "llvmpipe Mesa 22.3.6".
void add_device(StoredReport& report, KeyReader& keys) {
    KeyReader device(keys.at("device", &json::is_object, "an object"), report.file, "device/");
    report.device = device.text("name");
    report.driver = device.text("driver") + " " + device.text("driver_version");
    if (device.error()) keys.refuse(*device.error());
}

std::map<std::string, std::uint64_t> counters_of(KeyReader& keys) {
    std::map<std::string, std::uint64_t> counters;
    const json& all = keys.at("counters", &json::is_object, "an object");
    for (const auto& [name, value] : all.items()) {
        if (!value.is_number_unsigned()) keys.refuse_value("counters/" + name, "a whole number of 0 or more");
        else counters[name] = value.get<std::uint64_t>();
    }
    return counters;
}

/// True of an error for which JSON has no number, as cell_json() writes it.
bool is_not_finite(const json& error) { return error.is_string() && (error == "nan" || error == "inf" || error == "-inf"); }

void add_row(StoredReport& report, const json& json_row, KeyReader& row) {
    StoredRow made{.technique = row.text("technique"), .settings = row.text("settings")};
    if (row.error()) return;
    if (row.has("not_supported")) {
        ++report.not_supported;
        return;
    }
    if (row.has("has_other_truth") && json_row["has_other_truth"] == true) {
        ++report.with_other_truth;
        return;
    }
    for (const char* key : {"ranking_error", "repeats_ms"})
        if (!row.has(key)) {
            row.refuse(fail(Fault::bad_input, "compare.older_report",
                            "the rows of {file} have no '{key}': it was written by an older program; report again", report.file,
                            key));
            return;
        }
    if (is_not_finite(json_row["ranking_error"])) {
        ++report.without_finite_error;
        return;
    }
    made.error = row.number("ranking_error");
    made.repeats_ms = row.numbers("repeats_ms", 0);
    if (!report.time_unit.empty()) made.baseline_repeats_ms = row.numbers("baseline_repeats_ms", 1e-300);
    if (!report.time_unit.empty() && made.baseline_repeats_ms.size() != made.repeats_ms.size())
        row.refuse_value("baseline_repeats_ms", "as long as repeats_ms");
    made.bytes_per_pixel = row.number("bytes_per_pixel");
    made.counters = counters_of(row);
    report.rows.push_back(std::move(made));
}

/// Rows are found by their names.
std::optional<Error> row_twice(const StoredReport& report) {
    std::set<std::string> names;
    for (const StoredRow& row : report.rows)
        if (const std::string name = label(row.technique, row.settings); !names.insert(name).second)
            return fail(Fault::bad_input, "compare.row_twice", "{file} has two rows '{row}'", report.file, name);
    return {};
}

/// Everything above the rows.
StoredReport head_of(KeyReader& keys, const std::string& file) {
    StoredReport report{.file = file, .program = keys.text("program")};
    add_device(report, keys);
    report.capture_id = keys.text("capture_id");
    report.capture_name = keys.text("capture_name");
    report.truth = keys.text("truth");
    report.frame = keys.count("frame");
    const Extent extent = extent_of(keys);
    report.width = extent.width;
    report.height = extent.height;
    report.samples = keys.count("samples");
    report.stage = keys.text("stage");
    report.error_at = keys.text("error_at");
    report.time_unit = keys.text("time_unit");
    const std::string ranked_by = keys.text("ranked_by");
    report.ranked_by = {ranked_by, ranked_by.starts_with(display_rmse)};
    return report;
}

Result<StoredReport> report_of(const json& document, const std::string& file) {
    if (const auto wrong = wrong_document(document, file)) return *wrong;
    KeyReader keys(document, file);
    StoredReport report = head_of(keys, file);
    const json& rows = keys.at("rows", &json::is_array, "a list");
    if (keys.error()) return *keys.error();
    if (document.contains("stopped") && !document.contains("best_within"))
        return fail(Fault::bad_input, "compare.not_timed", "{file} was stopped before times were measured; report again", file);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        KeyReader row(rows[i], file, fmt::format("rows/{}/", i));
        add_row(report, rows[i], row);
        if (row.error()) return *row.error();
    }
    if (report.rows.empty())
        return fail(Fault::bad_input, "compare.no_ranked_row",
                    "{file} has no ranked row: no technique could do the frame, or it does not need the stage", file);
    if (const auto twice = row_twice(report)) return *twice;
    return report;
}

}  // namespace

Result<StoredReport> parse_report(std::string_view text, const std::filesystem::path& path) {
    const json document = json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (document.is_discarded())
        return fail(Fault::bad_input, "compare.not_json",
                    "{file} is not JSON, or cut short; write a report with strata report CAPTURE -o FILE.json", path.string());
    return report_of(document, path.string());
}

Result<StoredReport> read_report(const std::filesystem::path& path, MemoryBudget& budget) {
    const auto file = ReadableFile::open(path);
    if (!file) return file.error();
    // "[" becomes a value in a list of its own, which takes about 100 bytes.
    constexpr std::uint64_t bytes_per_letter = 128;
    if (const auto room = budget.has_room(file->size(), bytes_per_letter, path.filename().string()); !room) return room.error();
    const auto bytes = file->read(0, file->size());
    if (!bytes) return bytes.error();
    return parse_report({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path);
}

}  // namespace strata
