// Between values of frame.h and their stored twins: same size, same bits. A particle's bytes are the ones capture.fbs lists.
#pragma once

#include <bit>
#include <cstddef>
#include <type_traits>

#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"
#include "capture_format/frame/weather.h"
#include "capture_format/light_types.h"
#include "capture_format/schema/capture_generated.h"

namespace strata {

/// The same bits as another type, NaN payloads included.
template <typename To, typename From>
To bit_copy(const From& from) {
    return std::bit_cast<To>(from);
}

// Streams are stored as they lie in memory. When one of these fails, the struct has changed and the format must not.
static_assert(sizeof(glm::vec2) == 8 && sizeof(glm::vec3) == 12 && sizeof(glm::vec4) == 16);
static_assert(std::is_trivially_copyable_v<Particle> && sizeof(Particle) == 80);
static_assert(offsetof(Particle, center) == 0 && offsetof(Particle, size) == 24 && offsetof(Particle, rotation) == 28);
static_assert(offsetof(Particle, color) == 32 && offsetof(Particle, alpha) == 44 && offsetof(Particle, emissive) == 48);
static_assert(offsetof(Particle, uv_frame) == 60 && offsetof(Particle, depth_offset) == 76);

// Enums have the same values on both sides: a new enumerator is added to both.
static_assert(static_cast<unsigned>(schema::TextureFormat::MAX) == static_cast<unsigned>(TextureFormat::rgba32f));
static_assert(static_cast<unsigned>(schema::AddressMode::MAX) == static_cast<unsigned>(AddressMode::mirror_clamp));
static_assert(static_cast<unsigned>(schema::LightingModel::MAX) == static_cast<unsigned>(last_lighting_model));
static_assert(static_cast<unsigned>(schema::AlphaMode::MAX) == static_cast<unsigned>(AlphaMode::additive));
static_assert(static_cast<unsigned>(schema::Mobility::MAX) == static_cast<unsigned>(Mobility::moving));
static_assert(static_cast<unsigned>(schema::Resolution::MAX) == static_cast<unsigned>(Resolution::low));
static_assert(static_cast<unsigned>(schema::LightType::MAX) == static_cast<unsigned>(last_light_type));
static_assert(static_cast<unsigned>(schema::FogPath::MAX) == static_cast<unsigned>(FogPath::distance));
static_assert(static_cast<unsigned>(schema::VolumeKind::MAX) == static_cast<unsigned>(VolumeKind::fixed_local));
static_assert(static_cast<unsigned>(schema::VolumeOcclusion::MAX) == static_cast<unsigned>(VolumeOcclusion::axial));

}  // namespace strata
