// How every document of JSON begins: what it is, and what it is of.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "replay/gpu/device.h"

namespace strata {

/// What does not apply is left empty, null or 0, and out of the document.
struct DocumentHead {
    std::string_view schema;  ///< "strata.report"
    int version = 1;
    std::string date = {};  ///< utc_date()
    const DeviceInfo* device = nullptr;
    std::string capture_id = {}, capture_name = {};
    std::uint32_t width = 0, height = 0, samples = 0;  ///< of the frame, where it is of one
};

/// An object with the keys schema, schema_version, date, program, device, capture_id, capture_name, extent, samples.
nlohmann::ordered_json document(const DocumentHead&);
nlohmann::ordered_json json_of(const DeviceInfo&);

/// Seconds since 1970 as "2026-11-27T02:00:00Z".
std::string utc_date(std::int64_t seconds);

}  // namespace strata
