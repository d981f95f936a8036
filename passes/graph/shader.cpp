// Reflection with SPIRV-Cross, and the library of shaders. Only what the entry point statically uses counts: a shader includes
// the whole scene and is asked for the buffers it touches.
#include "passes/graph/shader.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <set>

#include <spirv_cross.hpp>

namespace strata {
namespace {

using spirv_cross::Compiler;
using spirv_cross::Resource;
using spirv_cross::SPIRType;

/// What reflect() gives up with; it never leaves reflect().
struct Unusable {
    Error error;
};

// FNV-1a, 64 bits, word by word: a name for the code, no defense against forgery.
std::uint64_t hash_of(std::span<const std::uint32_t> code) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const std::uint32_t word : code) hash = (hash ^ word) * 0x100000001b3u;
    return hash;
}

ShaderStage stage_of(const Compiler& compiler) {
    switch (compiler.get_execution_model()) {
        case spv::ExecutionModelGLCompute:
            return ShaderStage::compute;
        case spv::ExecutionModelVertex:
            return ShaderStage::vertex;
        case spv::ExecutionModelGeometry:
            return ShaderStage::geometry;
        case spv::ExecutionModelFragment:
            return ShaderStage::fragment;
        default:
            throw Unusable{fail(Fault::bad_input, "shader.unsupported_stage",
                                "it is neither a compute, a vertex, a geometry nor a fragment shader")};
    }
}

std::optional<Format> format_of(spv::ImageFormat format) {
    switch (format) {
        case spv::ImageFormatR8:
            return Format::r8_unorm;
        case spv::ImageFormatRgba8:
            return Format::rgba8_unorm;
        case spv::ImageFormatR16:
            return Format::r16_unorm;
        case spv::ImageFormatRgba16:
            return Format::rgba16_unorm;
        case spv::ImageFormatR16f:
            return Format::r16f;
        case spv::ImageFormatRg16f:
            return Format::rg16f;
        case spv::ImageFormatRgba16f:
            return Format::rgba16f;
        case spv::ImageFormatR11fG11fB10f:
            return Format::r11g11b10f;
        case spv::ImageFormatR32f:
            return Format::r32f;
        case spv::ImageFormatRg32f:
            return Format::rg32f;
        case spv::ImageFormatRgba32f:
            return Format::rgba32f;
        case spv::ImageFormatR8ui:
            return Format::r8ui;
        case spv::ImageFormatR32ui:
            return Format::r32ui;
        case spv::ImageFormatRg32ui:
            return Format::rg32ui;
        case spv::ImageFormatRgba32ui:
            return Format::rgba32ui;
        default:
            return std::nullopt;
    }
}

ShaderBinding placed(const Compiler& compiler, const Resource& resource, std::string name, BindingKind kind) {
    const SPIRType& type = compiler.get_type(resource.type_id);
    if (!type.array.empty())
        throw Unusable{fail(Fault::bad_input, "shader.resource_array", "'{binding}' is an array of resources", name)};
    return {.name = std::move(name),
            .set = compiler.get_decoration(resource.id, spv::DecorationDescriptorSet),
            .binding = compiler.get_decoration(resource.id, spv::DecorationBinding),
            .kind = kind};
}

ShaderBinding image_binding(const Compiler& compiler, const Resource& resource, BindingKind kind) {
    ShaderBinding binding = placed(compiler, resource, compiler.get_name(resource.id), kind);
    const SPIRType::ImageType& image = compiler.get_type(resource.type_id).image;
    if (image.dim != spv::Dim2D && image.dim != spv::Dim3D)
        throw Unusable{fail(Fault::bad_input, "shader.image_dimension", "'{binding}' is neither 2D nor 3D", binding.name)};
    binding.dimension = image.dim == spv::Dim3D ? ImageDimension::three : ImageDimension::two;
    binding.arrayed = image.arrayed;
    binding.multisampled = image.ms;
    const SPIRType::BaseType component = compiler.get_type(image.type).basetype;
    binding.integer = component == SPIRType::UInt || component == SPIRType::Int;
    if (kind == BindingKind::storage_image) {
        const spirv_cross::Bitset& flags = compiler.get_decoration_bitset(resource.id);
        binding.read = !flags.get(spv::DecorationNonReadable);
        binding.written = !flags.get(spv::DecorationNonWritable);
        binding.format = format_of(image.format);
    }
    return binding;
}

ShaderBinding buffer_binding(const Compiler& compiler, const Resource& resource, BindingKind kind) {
    ShaderBinding binding = placed(compiler, resource, compiler.get_name(resource.base_type_id), kind);
    if (kind == BindingKind::storage_buffer) {
        // readonly and writeonly stand on the members; SPIRV-Cross gives what all of them share.
        const spirv_cross::Bitset flags = compiler.get_buffer_block_flags(resource.id);
        binding.read = !flags.get(spv::DecorationNonReadable);
        binding.written = !flags.get(spv::DecorationNonWritable);
    }
    return binding;
}

std::vector<ShaderBinding> bindings_of(const Compiler& compiler, const spirv_cross::ShaderResources& resources) {
    if (!resources.separate_images.empty() || !resources.separate_samplers.empty() || !resources.subpass_inputs.empty())
        throw Unusable{
            fail(Fault::bad_input, "shader.unsupported_resource", "it separates images from samplers or reads subpass inputs")};
    std::vector<ShaderBinding> bindings;
    for (const Resource& r : resources.sampled_images) bindings.push_back(image_binding(compiler, r, BindingKind::sampled_image));
    for (const Resource& r : resources.storage_images) bindings.push_back(image_binding(compiler, r, BindingKind::storage_image));
    for (const Resource& r : resources.storage_buffers)
        bindings.push_back(buffer_binding(compiler, r, BindingKind::storage_buffer));
    for (const Resource& r : resources.uniform_buffers)
        bindings.push_back(buffer_binding(compiler, r, BindingKind::uniform_buffer));
    std::ranges::sort(bindings, {}, [](const ShaderBinding& b) { return std::pair(b.set, b.binding); });
    return bindings;
}

std::uint32_t member_bytes(const Compiler& compiler, const SPIRType& holder, std::uint32_t index) {
    const SPIRType& type = compiler.get_type(holder.member_types[index]);
    const bool runtime_array = !type.array.empty() && type.array.front() == 0;
    return runtime_array ? 0 : static_cast<std::uint32_t>(compiler.get_declared_struct_member_size(holder, index));
}

/// A struct within a block: the path of its members' names and its offset in the block.
struct NestedStruct {
    std::string block, path, holder;
    std::uint32_t offset = 0;
};

void flatten(const Compiler& compiler, const SPIRType& holder, const NestedStruct& nested, std::vector<BlockMember>& members) {
    for (std::uint32_t i = 0; i < holder.member_types.size(); ++i) {
        const SPIRType& type = compiler.get_type(holder.member_types[i]);
        const std::uint32_t offset = compiler.type_struct_member_offset(holder, i);
        const std::string path = nested.path + compiler.get_member_name(holder.self, i);
        members.push_back({.block = nested.block,
                           .name = path,
                           .offset = nested.offset + offset,
                           .bytes = member_bytes(compiler, holder, i),
                           .holder = nested.holder,
                           .offset_in_holder = offset,
                           .stride = type.array.empty() ? 0 : compiler.type_struct_member_array_stride(holder, i)});
        if (type.basetype != SPIRType::Struct) continue;
        // SPIRV-Cross gives an array of structs the `self` of the struct, which bears the names.
        flatten(compiler, compiler.get_type(type.self),
                {nested.block, path + ".", compiler.get_name(type.self), nested.offset + offset}, members);
    }
}

std::vector<BlockMember> members_of(const Compiler& compiler, const spirv_cross::ShaderResources& resources) {
    std::vector<BlockMember> members;
    for (const auto* blocks : {&resources.storage_buffers, &resources.uniform_buffers, &resources.push_constant_buffers}) {
        for (const Resource& r : *blocks) {
            const std::string block = compiler.get_name(r.base_type_id);
            flatten(compiler, compiler.get_type(r.base_type_id), {block, "", block, 0}, members);
        }
    }
    return members;
}

std::vector<ShaderConstant> constants_of(const Compiler& compiler) {
    std::vector<ShaderConstant> constants;
    for (const auto& constant : compiler.get_specialization_constants()) {
        const SPIRType& type = compiler.get_type(compiler.get_constant(constant.id).constant_type);
        const std::uint32_t bytes = type.basetype == SPIRType::Boolean ? 4 : type.width / 8;  // a VkBool32
        constants.push_back({compiler.get_name(constant.id), constant.constant_id, bytes});
    }
    return constants;
}

/// The group size, and the names of the constants it comes from. glslang leaves a bare local_size_x_id without a name.
void read_group(const Compiler& compiler, Shader& shader) {
    constexpr std::string_view bare_names[] = {"local_size_x", "local_size_y", "local_size_z"};
    std::uint32_t* const sizes[] = {&shader.group.width, &shader.group.height, &shader.group.depth};
    spirv_cross::SpecializationConstant from[3];
    compiler.get_work_group_size_specialization_constants(from[0], from[1], from[2]);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        *sizes[axis] = compiler.get_execution_mode_argument(spv::ExecutionModeLocalSize, axis);
        if (from[axis].id == spirv_cross::ConstantID(0)) continue;
        *sizes[axis] = compiler.get_constant(from[axis].id).scalar();
        const auto constant = std::ranges::find(shader.constants, from[axis].constant_id, &ShaderConstant::id);
        if (constant == shader.constants.end()) continue;
        if (constant->name.empty()) constant->name = bare_names[axis];
        shader.group_constants[axis] = constant->name;
    }
}

std::uint32_t color_outputs_of(const Compiler& compiler, const spirv_cross::ShaderResources& resources) {
    std::uint32_t outputs = 0;
    for (const Resource& r : resources.stage_outputs) {
        const auto& array = compiler.get_type(r.type_id).array;
        const std::uint32_t locations = array.empty() ? 1 : array.front();
        outputs = std::max(outputs, compiler.get_decoration(r.id, spv::DecorationLocation) + locations);
    }
    return outputs;
}

bool writes_layer(const spirv_cross::ShaderResources& resources) {
    return std::ranges::any_of(resources.builtin_outputs, [](const auto& output) { return output.builtin == spv::BuiltInLayer; });
}

Shader reflected_shader(std::string name, std::span<const std::uint32_t> code) {
    const Compiler compiler(code.data(), code.size());
    const auto resources = compiler.get_shader_resources(compiler.get_active_interface_variables());
    Shader shader;
    shader.name = std::move(name);
    shader.stage = stage_of(compiler);
    shader.code = code;
    shader.hash = hash_of(code);
    shader.bindings = bindings_of(compiler, resources);
    shader.constants = constants_of(compiler);
    shader.members = members_of(compiler, resources);
    for (const Resource& r : resources.push_constant_buffers)
        shader.push_bytes = static_cast<std::uint32_t>(compiler.get_declared_struct_size(compiler.get_type(r.base_type_id)));
    if (shader.stage == ShaderStage::compute) read_group(compiler, shader);
    if (shader.stage == ShaderStage::fragment) shader.color_outputs = color_outputs_of(compiler, resources);
    shader.chooses_layer = writes_layer(resources);
    return shader;
}

/// Throws std::bad_alloc where memory does not suffice to parse the code, which takes 75 to 210 bytes a word: SPIRV-Cross (0.54)
/// writes to what malloc returned without a look.
void expect_memory_to_parse(std::span<const std::uint32_t> code) {
    ::operator delete(::operator new(256 * code.size() + (64u << 10)));
}

}  // namespace

Result<Shader> reflect(std::string name, std::span<const std::uint32_t> code) {
    expect_memory_to_parse(code);
    // SPIRV-Cross throws on malformed words; its exceptions end here.
    try {
        return reflected_shader(name, code);
    } catch (const Unusable& unusable) {
        return within(unusable.error, "shader {shader} cannot be used", name);
    } catch (const spirv_cross::CompilerError& error) {
        return fail(Fault::bad_input, "shader.invalid_spirv", "shader {shader} is not valid SPIR-V: {reason}", name,
                    error.what());
    }
}

ShaderLibrary::ShaderLibrary() : mutex_(std::make_unique<std::mutex>()) {}

ShaderLibrary::ShaderLibrary(std::span<const EmbeddedShader> embedded) : ShaderLibrary() {
    for (const EmbeddedShader& shader : embedded) sources_.emplace(shader.name, shader.code);
}

ShaderLibrary::ShaderLibrary(const ShaderLibrary* under) : ShaderLibrary() { under_ = under; }

const ShaderLibrary& ShaderLibrary::built_in() {
    static const ShaderLibrary library(embedded_shaders());
    return library;
}

void ShaderLibrary::add(Shader shader) {
    const std::scoped_lock lock(*mutex_);
    std::string name = shader.name;
    shaders_.insert_or_assign(std::move(name), std::move(shader));
}

const Shader* ShaderLibrary::find(std::string_view name) const {
    const std::scoped_lock lock(*mutex_);
    if (const auto known = shaders_.find(name); known != shaders_.end()) return &known->second;
    const auto source = sources_.find(name);
    if (source == sources_.end()) return under_ ? under_->find(name) : nullptr;
    Result<Shader> shader = reflect(source->first, source->second);
    if (!shader) {  // what the build embedded is ours to get right, in every build
        fmt::print(stderr, "{}\n", shader.error().sentence);
        std::abort();
    }
    return &shaders_.emplace(source->first, std::move(*shader)).first->second;
}

std::uint64_t ShaderLibrary::replaced(std::string_view name) const {
    const std::scoped_lock lock(*mutex_);
    const auto own = shaders_.find(name);
    return under_ && own != shaders_.end() ? own->second.hash : 0;
}

std::vector<std::string> ShaderLibrary::names() const {
    const std::scoped_lock lock(*mutex_);
    std::set<std::string> all;
    if (under_)
        for (std::string& name : under_->names()) all.insert(std::move(name));
    for (const auto& [name, shader] : shaders_) all.insert(name);
    for (const auto& [name, code] : sources_) all.emplace(name);
    return {all.begin(), all.end()};
}

std::size_t ShaderLibrary::reflected() const {
    const std::scoped_lock lock(*mutex_);
    return shaders_.size();
}

}  // namespace strata
