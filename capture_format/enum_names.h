// The names of a frame's enumerators, as the schema spells them.
#pragma once

#include <string_view>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/texture.h"
#include "capture_format/frame/weather.h"

namespace strata {

std::string_view name(TextureFormat);
std::string_view name(AddressMode);
std::string_view name(TexelFilter);
std::string_view name(MipFilter);
std::string_view name(LightingModel);
std::string_view name(AlphaMode);
std::string_view name(FogPath);
std::string_view name(Mobility);
std::string_view name(Resolution);
std::string_view name(LightType);
std::string_view name(RangeWindow);
std::string_view name(VolumeKind);
std::string_view name(VolumeOcclusion);

}  // namespace strata
