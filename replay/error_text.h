// Errors for those who search for them and for scripts: their id and the values of their sentence.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "capture_format/result.h"

namespace strata {

/// One line: import.gltf.accessor_range: accessor=3 name="left hand" bytes=1024
std::string id_text(const Error&);
/// {"id", "kind", "exit_code", "sentence", "fields": {name: number or text}}.
nlohmann::ordered_json json_of(const Error&);

}  // namespace strata
