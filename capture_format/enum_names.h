// The names of a frame's enumerators, as the schema spells them.
#pragma once

#include <string_view>

#include "capture_format/frame.h"

namespace strata {

std::string_view name(TextureFormat);
std::string_view name(AddressMode);
std::string_view name(LightingModel);
std::string_view name(AlphaMode);
std::string_view name(FogPath);
std::string_view name(Mobility);
std::string_view name(Resolution);
std::string_view name(LightType);
std::string_view name(VolumeKind);
std::string_view name(VolumeOcclusion);

}  // namespace strata
