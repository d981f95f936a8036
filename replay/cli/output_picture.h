// A picture of an output of a replay: display light as it is, anything else with a scale.
#pragma once

#include <filesystem>
#include <string>

#include "replay/session/session.h"

namespace strata {

/// An image of Run::images by its name, enlarged under a title and over its scale; `of` says which capture and frame it is of.
Result<void> write_output_picture(const std::filesystem::path&, const Run&, const std::string& image, const std::string& of);

/// The same without words, one pixel a texel; what black and white stand for goes to standard error.
Result<void> write_plain_picture(const std::filesystem::path&, const Run&, const std::string& image);

/// A choice, "stage/technique key=value ..", without the settings that are the technique's defaults.
std::string without_defaults(const std::string& choice);

}  // namespace strata
