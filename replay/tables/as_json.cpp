// Sheets as JSON, and how every document of JSON begins.
#include <nlohmann/json.hpp>

#include "replay/program_version.h"
#include "replay/tables/document.h"
#include "replay/tables/sheet.h"

namespace strata {

using nlohmann::ordered_json;

void add_values(ordered_json& json, const Sheet& sheet, std::size_t row) {
    for (std::size_t i = 0; i < sheet.columns.size(); ++i) {
        const Described& is = sheet.columns[i];
        const CellValue& value = sheet.rows[row].values[i];
        if ((is.shown & in_json) == 0 || is_nothing(value)) continue;
        if (is.json.empty()) json[is.key] = cell_json(value);
        else json[ordered_json::json_pointer(is.json)] = cell_json(value);
    }
}

ordered_json rows_json(const Sheet& sheet) {
    ordered_json rows = ordered_json::array();
    for (std::size_t i = 0; i < sheet.rows.size(); ++i) {
        rows.push_back(ordered_json::object());
        add_values(rows.back(), sheet, i);
    }
    return rows;
}

ordered_json json_of(const DeviceInfo& device) {
    return {{"name", device.name},
            {"driver", device.driver},
            {"driver_version", device.driver_version},
            {"cpu", device.cpu},
            {"software", device.software}};
}

ordered_json document(const DocumentHead& head) {
    ordered_json json{{"schema", head.schema}, {"schema_version", head.version}};
    if (!head.date.empty()) json["date"] = head.date;
    json["program"] = program_version();
    if (head.device) json["device"] = json_of(*head.device);
    if (!head.capture_id.empty()) json["capture_id"] = head.capture_id;
    if (!head.capture_name.empty()) json["capture_name"] = head.capture_name;
    if (head.width > 0) json["extent"] = {head.width, head.height};
    if (head.samples > 0) json["samples"] = head.samples;
    return json;
}

}  // namespace strata
