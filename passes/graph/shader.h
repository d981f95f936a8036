// A compiled shader and what it says about itself: names, kinds and sizes, by reflection of its SPIR-V.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/result.h"
#include "passes/graph/step.h"

namespace strata {

enum class ShaderStage : std::uint32_t { compute, vertex, geometry, fragment };
enum class BindingKind : std::uint32_t { sampled_image, storage_image, storage_buffer, uniform_buffer };
enum class ImageDimension : std::uint32_t { two, three };

/// A resource the shader declares.
struct ShaderBinding {
    std::string name;
    std::uint32_t set = 0, binding = 0;
    BindingKind kind = BindingKind::storage_buffer;
    bool read = true, written = false;  ///< from readonly / writeonly
    ImageDimension dimension = ImageDimension::two;
    bool arrayed = false, multisampled = false;
    bool integer = false;               ///< usampler / uimage
    std::optional<Format> format = {};  ///< storage images: the declared format, if it is one of ours
};

struct ShaderConstant {
    std::string name;
    std::uint32_t id = 0;
    std::uint32_t bytes = 4;
};

/// A member of a block, for the layout tests: nested structs are flattened as "outer.inner", after the row of "outer" itself.
struct BlockMember {
    std::string block, name;
    std::uint32_t offset = 0, bytes = 0;  ///< offset in the block, in the first element of arrays; 0 bytes: a runtime array
    std::string holder;                   ///< the struct it is a member of; the block at the top
    std::uint32_t offset_in_holder = 0;
    std::uint32_t stride = 0;  ///< from element to element, 0 for what is no array
};

struct Shader {
    std::string name;  ///< "transparency/weighted/resolve.comp"
    ShaderStage stage = ShaderStage::compute;
    std::span<const std::uint32_t> code;
    std::uint64_t hash = 0;
    std::vector<ShaderBinding> bindings;
    std::vector<ShaderConstant> constants;
    std::vector<BlockMember> members;
    std::uint32_t push_bytes = 0;
    Extent group{1, 1, 1};                       ///< threads; where a specialization constant says so, its default
    std::array<std::string, 3> group_constants;  ///< their names where local_size_?_id is used, else empty
    std::uint32_t color_outputs = 0;             ///< fragment: highest location + 1
    bool chooses_layer = false;                  ///< writes gl_Layer
};

/// What draws the scene's meshes unless a draw has a vertex shader of its own.
inline constexpr const char* mesh_vertex_shader = "shaders/draw.vert";
/// The same for lists of places.
inline constexpr const char* numbered_vertex_shader = "shaders/numbered_draw.vert";

/// Which of the two draws a list.
inline const char* scene_vertex_shader(const DrawList& list) {
    return list.of_places ? numbered_vertex_shader : mesh_vertex_shader;
}

/// Reflects SPIR-V. Fails with a sentence when it is not SPIR-V we can use.
Result<Shader> reflect(std::string name, std::span<const std::uint32_t> code);

/// One shader as the build embedded it.
struct EmbeddedShader {
    std::string_view name;
    std::span<const std::uint32_t> code;
};
/// The shaders by name. Looking one up reflects it the first time: a shader no stage needs is never touched.
class ShaderLibrary {
public:
    ShaderLibrary();
    explicit ShaderLibrary(std::span<const EmbeddedShader>);
    /// What is added stands in for the shaders of the same names in another library, which must outlive this one.
    explicit ShaderLibrary(const ShaderLibrary* under);
    /// The shaders built into the program.
    static const ShaderLibrary& built_in();
    void add(Shader);
    /// Null when there is none.
    const Shader* find(std::string_view name) const;
    /// Hash of the shader that stands in for one of the library below; 0 where none does.
    std::uint64_t replaced(std::string_view name) const;
    std::vector<std::string> names() const;
    /// Shaders reflected or added so far: what "only what the scene calls for" counts.
    std::size_t reflected() const;

private:
    std::map<std::string, std::span<const std::uint32_t>, std::less<>> sources_;  ///< not looked up yet or already in shaders_
    mutable std::map<std::string, Shader, std::less<>> shaders_;
    const ShaderLibrary* under_ = nullptr;
    std::unique_ptr<std::mutex> mutex_;  ///< guards shaders_: sessions on several threads share the built-in library
};

/// Written by the build from the list of techniques.
std::span<const EmbeddedShader> embedded_shaders();

}  // namespace strata
