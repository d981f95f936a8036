// Shaders read enums of a capture as numbers. Their constants in *.shared.h have the values of capture_format/frame.h: an
// enumerator in the middle of an enum stops the build here.
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/texture.h"
#include "capture_format/frame/weather.h"
#include "capture_format/light_types.h"
#include "passes/shaders/light_types.shared.h"
#include "passes/shaders/scene.shared.h"
#include "passes/shaders/textures.shared.h"

namespace strata {
namespace {

template <typename Enum>
constexpr uint in_glsl(Enum value) {
    return static_cast<uint>(value);
}

static_assert(light_omni == in_glsl(LightType::omni));
static_assert(light_round_spot == in_glsl(LightType::round_spot));
static_assert(light_square_spot == in_glsl(LightType::square_spot));
static_assert(light_tube == in_glsl(LightType::tube));
static_assert(light_sphere == in_glsl(LightType::sphere));
static_assert(light_disc == in_glsl(LightType::disc));
static_assert(light_rectangle == in_glsl(LightType::rectangle));
static_assert(light_directional == in_glsl(LightType::directional));
static_assert(light_type_table.size() == 8, "light_types.shared.h has every type");

static_assert(window_squared_quartic == in_glsl(RangeWindow::squared_quartic));
static_assert(window_quartic == in_glsl(RangeWindow::quartic));

static_assert(model_unlit == in_glsl(LightingModel::unlit));
static_assert(model_lambert == in_glsl(LightingModel::lambert));
static_assert(model_burley == in_glsl(LightingModel::burley));
static_assert(model_ggx == in_glsl(LightingModel::ggx));
static_assert(model_cloth == in_glsl(LightingModel::cloth));
static_assert(model_skin == in_glsl(LightingModel::skin));
static_assert(model_hair == in_glsl(LightingModel::hair));
static_assert(model_plain_burley == in_glsl(LightingModel::plain_burley));
static_assert(model_multiscatter_ggx == in_glsl(LightingModel::multiscatter_ggx));
static_assert(last_lighting_model == LightingModel::multiscatter_ggx, "scene.shared.h has every model");

static_assert(alpha_opaque == in_glsl(AlphaMode::opaque));
static_assert(alpha_mask == in_glsl(AlphaMode::mask));
static_assert(alpha_blend == in_glsl(AlphaMode::blend));
static_assert(alpha_premultiplied == in_glsl(AlphaMode::premultiplied));
static_assert(alpha_additive == in_glsl(AlphaMode::additive));

static_assert(fog_by_view_depth == in_glsl(FogPath::view_depth));
static_assert(fog_by_distance == in_glsl(FogPath::distance));

static_assert(texture_rgba8_unorm == in_glsl(TextureFormat::rgba8_unorm));
static_assert(texture_rgba8_srgb == in_glsl(TextureFormat::rgba8_srgb));
static_assert(texture_rgba16f == in_glsl(TextureFormat::rgba16f));
static_assert(texture_rgba32f == in_glsl(TextureFormat::rgba32f));

static_assert(address_repeat == in_glsl(AddressMode::repeat));
static_assert(address_clamp == in_glsl(AddressMode::clamp));
static_assert(in_glsl(AddressMode::mirror) == 2 && address_clamp_both == (address_clamp | address_clamp << 2u),
              "two bits hold the mode of one direction");
static_assert(in_glsl(TexelFilter::nearest) == 1, "a bit of TextureRecord::sampling is set for nearest");
static_assert(mip_linear == in_glsl(MipFilter::linear));
static_assert(mip_nearest == in_glsl(MipFilter::nearest));
static_assert(mip_none == in_glsl(MipFilter::none));

}  // namespace
}  // namespace strata
