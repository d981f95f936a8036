#include "capture_format/enum_names.h"

#include "capture_format/schema/capture_generated.h"

namespace strata {

std::string_view name(TextureFormat value) { return schema::EnumNameTextureFormat(static_cast<schema::TextureFormat>(value)); }
std::string_view name(AddressMode value) { return schema::EnumNameAddressMode(static_cast<schema::AddressMode>(value)); }
std::string_view name(TexelFilter value) { return schema::EnumNameTexelFilter(static_cast<schema::TexelFilter>(value)); }
std::string_view name(MipFilter value) { return schema::EnumNameMipFilter(static_cast<schema::MipFilter>(value)); }
std::string_view name(LightingModel value) { return schema::EnumNameLightingModel(static_cast<schema::LightingModel>(value)); }
std::string_view name(FogPath value) { return schema::EnumNameFogPath(static_cast<schema::FogPath>(value)); }
std::string_view name(AlphaMode value) { return schema::EnumNameAlphaMode(static_cast<schema::AlphaMode>(value)); }
std::string_view name(Mobility value) { return schema::EnumNameMobility(static_cast<schema::Mobility>(value)); }
std::string_view name(Resolution value) { return schema::EnumNameResolution(static_cast<schema::Resolution>(value)); }
std::string_view name(LightType value) { return schema::EnumNameLightType(static_cast<schema::LightType>(value)); }
std::string_view name(RangeWindow value) { return schema::EnumNameRangeWindow(static_cast<schema::RangeWindow>(value)); }
std::string_view name(VolumeKind value) { return schema::EnumNameVolumeKind(static_cast<schema::VolumeKind>(value)); }
std::string_view name(VolumeOcclusion value) {
    return schema::EnumNameVolumeOcclusion(static_cast<schema::VolumeOcclusion>(value));
}

}  // namespace strata
