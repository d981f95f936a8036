// Remembers the first thing that is wrong with a frame, as a sentence that names where it is.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame.h"
#include "capture_format/result.h"

namespace strata {

/// Longest name, key or text of a frame in bytes. Tables may be shared inside a hostile file: unbounded names multiply.
inline constexpr std::size_t longest_text = 255;
/// Largest edge of a view or a texture in pixels: Vulkan's maxImageDimension2D of every device we know.
inline constexpr std::uint32_t largest_extent = 16384;
/// How far a direction's length and the cosine between perpendicular ones may be off: half floats and 8-bit sources pass.
inline constexpr double unit_tolerance = 2e-3;

/// Where the inspection is: "material 3 'glass'".
struct Subject {
    std::string_view kind;
    std::size_t index = only_one;
    std::string_view name = {};

    static constexpr std::size_t only_one = static_cast<std::size_t>(-1);  ///< there is just one, it has no number
};

class Inspection {
public:
    /// What the next expectations are about.
    void at(Subject subject) { subject_ = subject; }
    /// False when it does not hold; the first sentence stays.
    template <typename... Args>
    bool expect(bool holds, fmt::format_string<Args...> sentence, Args&&... args) {
        if (!holds && !error_) error_ = located(fmt::format(sentence, std::forward<Args>(args)...));
        return holds;
    }
    Result<void> verdict() const { return error_ ? Result<void>(*error_) : Result<void>(); }
    bool failed() const { return error_.has_value(); }

private:
    Error located(std::string_view sentence) const;

    Subject subject_;
    std::optional<Error> error_;
};

inline bool finite(double value) { return std::isfinite(value); }
template <int n, typename T>
bool finite(const glm::vec<n, T>& value) {
    for (int i = 0; i < n; ++i) {
        if (!std::isfinite(value[i])) return false;
    }
    return true;
}

/// Finite and within the closed range.
inline bool within(double value, double low, double high) { return value >= low && value <= high; }
/// Finite and not negative.
inline bool positive_or_zero(double value) { return std::isfinite(value) && value >= 0; }
/// Finite and above zero.
inline bool positive(double value) { return std::isfinite(value) && value > 0; }

inline bool unit(const glm::dvec3& v) { return std::abs(glm::dot(v, v) - 1) <= 2 * unit_tolerance; }
inline bool perpendicular(const glm::dvec3& a, const glm::dvec3& b) { return std::abs(glm::dot(a, b)) <= unit_tolerance; }

/// True for an enum value from the first to `last`.
template <typename Enum>
bool known(Enum value, Enum last) {
    return static_cast<std::uint32_t>(value) <= static_cast<std::uint32_t>(last);
}

/// True for no_index and for an index into a list of the given size.
inline bool optional_index(std::uint32_t index, std::size_t size) { return index == no_index || index < size; }

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
