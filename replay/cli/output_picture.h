// A picture of an output of a replay, for people: display light as it is, anything else under a title, with its scale.
#pragma once

#include <filesystem>
#include <string>

#include "replay/session/session.h"

namespace strata {

/// An image of Run::images by its name; `of` says which capture and frame it is of.
Result<void> write_output_picture(const std::filesystem::path&, const Run&, const std::string& image, const std::string& of);

/// A choice, "stage/technique key=value ..", without the settings that are the technique's defaults.
std::string without_defaults(const std::string& choice);

}  // namespace strata
