// Remembers the first thing that is wrong with a frame, as a sentence that names where it is.
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame/material.h"
#include "capture_format/result.h"

namespace strata {

struct Frame;    // capture_format/frame.h
struct Mesh;     // capture_format/frame/mesh.h
struct Texture;  // capture_format/frame/texture.h

/// Longest name, key or text of a frame in bytes. Tables may be shared inside a hostile file: unbounded names multiply.
inline constexpr std::size_t longest_text = 255;
/// Largest edge of a view or a texture in pixels: Vulkan's maxImageDimension2D of every device we know.
inline constexpr std::uint32_t largest_extent = 16384;
/// How far a direction's length and the cosine between perpendicular ones may be off: half floats and 8-bit sources pass.
inline constexpr double unit_tolerance = 2e-3;

inline bool finite(double value) { return std::isfinite(value); }
template <int n, typename T>
bool finite(const glm::vec<n, T>& value) {
    for (int i = 0; i < n; ++i) {
        if (!std::isfinite(value[i])) return false;
    }
    return true;
}

inline bool within(double value, double low, double high) { return value >= low && value <= high; }
inline bool positive_or_zero(double value) { return std::isfinite(value) && value >= 0; }
inline bool positive(double value) { return std::isfinite(value) && value > 0; }

inline bool unit(const glm::dvec3& v) { return std::abs(glm::dot(v, v) - 1) <= 2 * unit_tolerance; }
inline bool perpendicular(const glm::dvec3& a, const glm::dvec3& b) { return std::abs(glm::dot(a, b)) <= unit_tolerance; }

/// True for an enum value from the first to `last`.
template <typename Enum>
bool known(Enum value, Enum last) {
    return static_cast<std::uint32_t>(value) <= static_cast<std::uint32_t>(last);
}

/// Where the inspection is: "material 3 'glass'", or "emitter 0 'smoke': particle 7".
struct Subject {
    std::string_view kind;
    std::size_t index = only_one;
    std::string_view name = {}, part = {};
    std::size_t part_index = 0;

    static constexpr std::size_t only_one = static_cast<std::size_t>(-1);  ///< there is just one, it has no number
};

/// The error about a name, a key or a text above longest_text.
Error too_long_name(std::size_t bytes);

/// Each expectation returns whether it holds; the first error stays. A property or a list is named as sentences begin with it.
class Inspection {
public:
    /// What the next expectations are about.
    void at(Subject subject) { subject_ = subject; }
    template <typename... Args>
    bool expect(bool holds, ErrorId id, std::type_identity_t<detail::Sentence<Args...>> sentence, Args&&... args) {
        if (!holds && !error_) error_ = located(fail(Fault::bad_input, id, sentence, std::forward<Args>(args)...));
        return holds;
    }
    template <typename T>
    bool expect_finite(std::string_view property, const T& value) {
        return expect(finite(value), "frame.not_finite", "{property} is not finite", property);
    }
    template <typename T>
    bool expect_not_negative(std::string_view property, T value) {
        return expect(positive_or_zero(value), "frame.negative", "{property} must be 0 or above, not {value}", property, value);
    }
    template <typename T>
    bool expect_positive(std::string_view property, T value) {
        return expect(positive(value), "frame.not_positive", "{property} must be above 0, not {value}", property, value);
    }
    template <typename T>
    bool expect_within(std::string_view property, T value, double least, double most) {
        return expect(within(value, least, most), "frame.range", "{property} must be {least} to {most}, not {value}", property,
                      least, most, value);
    }
    bool expect_unit(std::string_view property, const glm::dvec3& value) {
        return expect(unit(value), "frame.not_unit", "{property} must be a unit vector", property);
    }
    bool expect_perpendicular(std::string_view property, std::string_view other, const glm::dvec3& a, const glm::dvec3& b) {
        return expect(perpendicular(a, b), "frame.not_perpendicular", "{property} must be perpendicular to {other}", property,
                      other);
    }
    template <typename Enum>
    bool expect_known(std::string_view property, Enum value, Enum last) {
        return expect(known(value, last), "frame.unknown_value", "{property} {value} does not exist", property,
                      static_cast<std::uint32_t>(value));
    }
    bool expect_index(std::string_view list, std::uint32_t index, std::size_t count) {
        return expect(index < count, "frame.index_range", "{list} {index} does not exist: there are {count}", list, index, count);
    }
    bool expect_optional_index(std::string_view list, std::uint32_t index, std::size_t count) {
        return index == no_index || expect_index(list, index, count);
    }
    bool expect_at_most(std::string_view list, std::size_t count, std::size_t most) {
        return expect(count <= most, "frame.too_many", "{count} {list} are too many; the limit is {most}", count, list, most);
    }
    bool expect_extent(std::uint32_t width, std::uint32_t height) {
        return expect(within(width, 1, largest_extent) && within(height, 1, largest_extent), "frame.extent",
                      "the extent must be 1 to {most} each way, not {width} x {height}", largest_extent, width, height);
    }
    bool expect_name(std::string_view text) {
        if (text.size() > longest_text && !error_) error_ = located(too_long_name(text.size()));
        return text.size() <= longest_text;
    }
    Result<void> verdict() const { return error_ ? Result<void>(*error_) : Result<void>(); }
    bool failed() const { return error_.has_value(); }

private:
    Error located(Error) const;

    Subject subject_;
    std::optional<Error> error_;
};

/// What the inspection of draws needs to know of a mesh. The name must live as long.
struct MeshShape {
    std::string_view name;
    bool empty = true, has_uv0 = false, has_uv1 = false;
};
/// What the rest of a frame refers to, when its bytes are elsewhere.
struct ResourceShapes {
    std::size_t textures = 0;
    std::vector<MeshShape> meshes;
    std::span<const Material> materials;
};

/// Parts of check_frame().
void inspect_texture(Inspection&, const Texture&);
void inspect_mesh(Inspection&, const Mesh&);
void inspect_submissions(Inspection&, const Frame&, const ResourceShapes&);  ///< materials, draws, emitters
void inspect_lights(Inspection&, const Frame&, std::size_t textures);        ///< lights, blockers, portals, sun, light volumes

/// check_frame() of all but textures and meshes, which must have passed before.
Result<void> check_submissions(const Frame&, const ResourceShapes&);

}  // namespace strata
