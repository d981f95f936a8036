// Every scalar of a frame, visited. A field that is added to frame.h and forgotten here does not compile: the structured
// bindings must name them all. Independent of the encoder, so that it can judge it.
#pragma once

#include <array>
#include <cstring>
#include <random>
#include <tuple>
#include <type_traits>

#include "capture_format/frame.h"

namespace strata {

template <typename T, typename Wanted>
concept Is = std::is_same_v<std::remove_const_t<T>, Wanted>;

// clang-format off
auto fields(Is<View> auto& v) { auto& [a, b, c, d, e, f, g, h, i] = v; return std::tie(a, b, c, d, e, f, g, h, i); }
auto fields(Is<Texture> auto& v) {
    auto& [a, b, c, d, e, f, g, h, i, j] = v;
    return std::tie(a, b, c, d, e, f, g, h, i, j);
}
auto fields(Is<Mesh> auto& v) { auto& [a, b, c, d, e, f, g, h] = v; return std::tie(a, b, c, d, e, f, g, h); }
auto fields(Is<TextureUse> auto& v) { auto& [a, b, c] = v; return std::tie(a, b, c); }
auto fields(Is<Material> auto& v) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = v;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r);
}
auto fields(Is<Draw> auto& v) { auto& [a, b, c, d, e, f, g, h, i, j] = v; return std::tie(a, b, c, d, e, f, g, h, i, j); }
auto fields(Is<Particle> auto& v) { auto& [a, b, c, d, e, f, g, h] = v; return std::tie(a, b, c, d, e, f, g, h); }
auto fields(Is<Emitter> auto& v) { auto& [a, b, c, d, e, f, g, h] = v; return std::tie(a, b, c, d, e, f, g, h); }
auto fields(Is<ShadowUse> auto& v) { auto& [a, b, c, d] = v; return std::tie(a, b, c, d); }
auto fields(Is<ClipPlane> auto& v) { auto& [a, b] = v; return std::tie(a, b); }
auto fields(Is<Light> auto& v) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = v;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q);
}
auto fields(Is<Blocker> auto& v) { auto& [a, b, c, d, e, f] = v; return std::tie(a, b, c, d, e, f); }
auto fields(Is<Portal> auto& v) { auto& [a, b, c, d, e, f] = v; return std::tie(a, b, c, d, e, f); }
auto fields(Is<Sun> auto& v) { auto& [a, b, c, d, e, f, g] = v; return std::tie(a, b, c, d, e, f, g); }
auto fields(Is<Hemisphere> auto& v) { auto& [a, b] = v; return std::tie(a, b); }
auto fields(Is<Fog> auto& v) { auto& [a, b, c] = v; return std::tie(a, b, c); }
auto fields(Is<LightVolume> auto& v) { auto& [a, b, c, d, e, f, g] = v; return std::tie(a, b, c, d, e, f, g); }
auto fields(Is<Rain> auto& v) { auto& [a, b, c] = v; return std::tie(a, b, c); }
auto fields(Is<Lens> auto& v) { auto& [a, b, c, d, e, f, g] = v; return std::tie(a, b, c, d, e, f, g); }
auto fields(Is<Film> auto& v) { auto& [a, b, c] = v; return std::tie(a, b, c); }
auto fields(Is<Setting> auto& v) { auto& [a, b] = v; return std::tie(a, b); }
auto fields(Is<StageChoice> auto& v) { auto& [a, b, c] = v; return std::tie(a, b, c); }
auto fields(Is<Frame> auto& v) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, pre_exposure] = v;
    static_cast<void>(pre_exposure);  // of the replay, and no part of a capture
    return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u);
}
// clang-format on

template <typename T>
concept Scalar = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <typename T>
concept HasLength = requires(T& value) {
    value.length();
    value[0];
}
&&!Is<T, std::string>;
template <typename T>
concept List = requires(T& value) {
    value.begin();
    value.data();
}
&&!Is<T, std::string>;

/// Shows every scalar, text, list and choice of a value to the visitor, in a fixed order.
template <typename T, typename Visitor>
void walk(T& value, Visitor& visitor) {
    if constexpr (Scalar<T>) {
        visitor.scalar(value);
    } else if constexpr (Is<T, std::string>) {
        visitor.text(value);
    } else if constexpr (HasLength<T>) {
        for (int i = 0; i < static_cast<int>(value.length()); ++i) walk(value[i], visitor);
    } else if constexpr (List<T>) {
        visitor.list(value);
        for (auto& element : value) walk(element, visitor);
    } else if constexpr (Is<T, SettingValue>) {
        visitor.choice(value);
        std::visit([&](auto& held) { walk(held, visitor); }, value);
    } else {
        std::apply([&](auto&... field) { (walk(field, visitor), ...); }, fields(value));
    }
}

/// All bits of a frame, one after the other.
struct FieldBits {
    std::vector<std::byte> bytes;
    void raw(const void* data, std::size_t size) {
        const auto* first = static_cast<const std::byte*>(data);
        bytes.insert(bytes.end(), first, first + size);
    }
    void scalar(const auto& value) { raw(&value, sizeof(value)); }
    void text(const std::string& value) { raw(value.c_str(), value.size() + 1); }
    void list(const auto& values) { scalar(values.size()); }
    void choice(const SettingValue& value) { scalar(value.index()); }
};

inline std::vector<std::byte> bits_of(const Frame& frame) {
    FieldBits bits;
    walk(frame, bits);
    return std::move(bits.bytes);
}

/// Random bits in every scalar: NaN payloads, infinities, denormals, minus zero. No frame that could be replayed.
struct RandomBits {
    std::mt19937_64 random;
    void scalar(auto& value) {
        const std::uint64_t bits = random();
        std::memcpy(&value, &bits, sizeof(value));
    }
    void scalar(bool& value) { value = random() % 2 != 0; }
    template <typename Enum>
    requires(std::is_enum_v<Enum> && !std::is_same_v<Enum, std::byte>) void scalar(Enum& value) {
        value = static_cast<Enum>(random() % 2);
    }
    void text(std::string& value) { value = "text " + std::to_string(random() % 1000); }
    template <typename T>
    void list(std::vector<T>& values) {
        values.resize(1 + random() % 4);
    }
    template <typename T, std::size_t n>
    void list(std::array<T, n>&) {}
    void choice(SettingValue& value) {
        const SettingValue kinds[] = {std::int64_t{0}, 0.0, std::string()};
        value = kinds[random() % 3];
    }
};

}  // namespace strata
