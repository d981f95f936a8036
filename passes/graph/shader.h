// A compiled shader and what it says about itself: names, kinds and sizes, by reflection of its SPIR-V.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/result.h"
#include "passes/graph/graph.h"

namespace strata {

enum class ShaderStage : std::uint32_t { compute, vertex, fragment };
enum class BindingKind : std::uint32_t { sampled_image, storage_image, storage_buffer, uniform_buffer };
enum class ImageDimension : std::uint32_t { two, three };

/// A resource the shader declares.
struct ShaderBinding {
    std::string name;
    std::uint32_t set = 0, binding = 0;
    BindingKind kind = BindingKind::storage_buffer;
    bool read = true, written = false;     ///< from readonly / writeonly
    ImageDimension dimension = ImageDimension::two;
    bool arrayed = false, multisampled = false;
    bool integer = false;                  ///< usampler / uimage
};

struct ShaderConstant {
    std::string name;
    std::uint32_t id = 0;
    std::uint32_t bytes = 4;
};

/// A member of a block, for the layout tests: nested structs are flattened as "outer.inner".
struct BlockMember {
    std::string block, name;
    std::uint32_t offset = 0, bytes = 0;
};

struct Shader {
    std::string name;                      ///< "transparency/weighted/resolve.comp"
    ShaderStage stage = ShaderStage::compute;
    std::span<const std::uint32_t> code;
    std::uint64_t hash = 0;
    std::vector<ShaderBinding> bindings;
    std::vector<ShaderConstant> constants;
    std::vector<BlockMember> members;
    std::uint32_t push_bytes = 0;
    Extent group{1, 1, 1};
    std::uint32_t color_outputs = 0;       ///< fragment: highest location + 1
};

/// Reflects SPIR-V. Fails with a sentence when it is not SPIR-V we can use.
Result<Shader> reflect(std::string name, std::span<const std::uint32_t> code);

/// The shaders by name. Looking one up reflects it the first time: a shader no stage needs is never touched.
class ShaderLibrary {
public:
    /// The shaders built into the program.
    static const ShaderLibrary& built_in();
    void add(Shader);
    /// Null when there is none.
    const Shader* find(std::string_view name) const;
    std::vector<std::string> names() const;

private:
    mutable std::map<std::string, Shader, std::less<>> shaders_;
};

/// One shader as the build embedded it.
struct EmbeddedShader {
    std::string_view name;
    std::span<const std::uint32_t> code;
};
/// Written by the build from the list of techniques.
std::span<const EmbeddedShader> embedded_shaders();

}  // namespace strata
