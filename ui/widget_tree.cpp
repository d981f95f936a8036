#include "ui/widget_tree.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "replay/json_text.h"

namespace strata::ui {

std::string widget_tree(const Inspector& inspector) {
    using Json = nlohmann::ordered_json;
    Json widgets = Json::array();
    for (const WidgetRecord& record : inspector.widgets().records())
        widgets.push_back({{"path", record.path},
                           {"kind", name(record.kind)},
                           {"value", record.value},
                           {"from", {record.from.x, record.from.y}},
                           {"to", {record.to.x, record.to.y}},
                           {"enabled", record.enabled},
                           {"visible", record.visible},
                           {"updating", record.updating}});
    const FrameRate& rate = inspector.frame_rate();
    const auto tenths = [](double number) { return std::round(number * 10) / 10; };
    const Json json{{"schema", "strata.widgets"},
                    {"schema_version", 1},
                    {"title", inspector.title()},
                    {"command", inspector.model().command_line()},
                    {"settled", inspector.is_settled()},
                    {"frames_per_second", tenths(rate.per_second())},
                    {"slowest_frame_ms", tenths(rate.slowest_ms())},
                    {"widgets", std::move(widgets)}};
    return json_text(json);
}

}  // namespace strata::ui
