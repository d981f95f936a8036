#include "replay/expectations/provenance.h"

#include <nlohmann/json.hpp>

#include "replay/revision.h"

namespace strata {

Metadata provenance(const Origin& origin, const Request& request, const Run& run) {
    const nlohmann::ordered_json choices(run.choices);
    const DeviceInfo& device = origin.device;
    Metadata metadata{{"software", fmt::format("strata {}", tool_revision)},
                      {"strata.capture", origin.capture_id},
                      {"strata.frame", std::to_string(request.variant.frame)},
                      {"strata.settings", choices.dump()},
                      {"strata.device", device.name},
                      {"strata.driver", device.driver + " " + device.driver_version},
                      {"strata.cpu", device.cpu}};
    if (const std::string eye = text(request.variant.eye); !eye.empty()) metadata["strata.eye"] = eye;
    for (const auto& [name, image] : run.images) metadata["strata.hash." + name] = hash_of(image);
    return metadata;
}

}  // namespace strata
