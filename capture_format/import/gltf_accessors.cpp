#include "capture_format/import/gltf_accessors.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string_view>

namespace strata::gltf {
namespace {

/// An accessor without a buffer view is all zeros and costs its writer nothing, so its size is bounded here.
constexpr std::size_t most_implicit_elements = std::size_t{1} << 24;

/// Where elements of one kind lie: element i begins at bytes[i * stride].
struct Elements {
    std::span<const unsigned char> bytes;
    std::size_t stride = 0, count = 0;
};

struct Layout {
    int view = -1;
    std::size_t offset = 0, count = 0, element_bytes = 0;
};

Result<std::span<const unsigned char>> view_bytes(const tinygltf::Model& model, int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= model.bufferViews.size()) {
        return fail(Fault::bad_input, "buffer view {} does not exist (there are {})", index, model.bufferViews.size());
    }
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) {
        return fail(Fault::bad_input, "buffer view {} names buffer {}, which does not exist", index, view.buffer);
    }
    const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
        return fail(Fault::bad_input, "buffer view {} leaves its buffer of {} bytes", index, data.size());
    }
    return std::span<const unsigned char>(data).subspan(view.byteOffset, view.byteLength);
}

Result<Elements> locate(const tinygltf::Model& model, const Layout& layout) {
    const auto bytes = view_bytes(model, layout.view);
    if (!bytes) return bytes.error();
    const std::size_t given = model.bufferViews[static_cast<std::size_t>(layout.view)].byteStride;
    const std::size_t stride = given == 0 ? layout.element_bytes : given;
    if (layout.count == 0) return Elements{{}, stride, 0};
    const std::size_t length = bytes->size();
    const bool inside = stride >= layout.element_bytes && layout.offset <= length &&
                        length - layout.offset >= layout.element_bytes &&
                        layout.count - 1 <= (length - layout.offset - layout.element_bytes) / stride;
    if (!inside) {
        return fail(Fault::bad_input, "{} elements of {} bytes, {} apart from byte {}, leave buffer view {} of {} bytes",
                    layout.count, layout.element_bytes, stride, layout.offset, layout.view, length);
    }
    return Elements{bytes->subspan(layout.offset), stride, layout.count};
}

template <typename T>
T load(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));  // unaligned in hostile files; glTF is little-endian like every host we build on
    return value;
}

/// glTF 2.0, 3.6.2.2: signed normalized integers map their lowest value to -1 as well.
float component(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: {
            const float value = load<std::int8_t>(bytes);
            return normalized ? std::max(value / 127.0f, -1.0f) : value;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return static_cast<float>(*bytes) / (normalized ? 255.0f : 1.0f);
        case TINYGLTF_COMPONENT_TYPE_SHORT: {
            const float value = load<std::int16_t>(bytes);
            return normalized ? std::max(value / 32767.0f, -1.0f) : value;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return static_cast<float>(load<std::uint16_t>(bytes)) / (normalized ? 65535.0f : 1.0f);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return static_cast<float>(load<std::uint32_t>(bytes));
        default:
            return load<float>(bytes);
    }
}

std::uint32_t index_value(const unsigned char* bytes, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return *bytes;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

/// 0 for types that no vertex attribute or index has.
std::size_t component_bytes(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            return 0;
    }
}

bool is_index_type(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

Result<const tinygltf::Accessor*> find_accessor(const tinygltf::Model& model, int index, std::uint32_t components) {
    if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) {
        return fail(Fault::bad_input, "accessor {} does not exist (there are {})", index, model.accessors.size());
    }
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    if (component_count(model, index) != components) {
        return fail(Fault::bad_input, "accessor {} has {} components where {} are expected", index, component_count(model, index),
                    components);
    }
    if (component_bytes(accessor.componentType) == 0) {
        return fail(Fault::bad_input, "accessor {} has unknown component type {}", index, accessor.componentType);
    }
    if (accessor.bufferView < 0 && accessor.count > most_implicit_elements) {
        return fail(Fault::bad_input, "accessor {} has {} elements but no buffer view", index, accessor.count);
    }
    return &accessor;
}

void unpack(const Elements& source, const tinygltf::Accessor& accessor, std::uint32_t components, std::span<float> target) {
    const std::size_t size = component_bytes(accessor.componentType);
    for (std::size_t i = 0; i < source.count; ++i) {
        for (std::uint32_t c = 0; c < components; ++c) {
            target[i * components + c] =
                component(source.bytes.data() + i * source.stride + c * size, accessor.componentType, accessor.normalized);
        }
    }
}

/// The elements a sparse accessor replaces: values[i] goes to element indices[i].
struct Replacements {
    std::vector<std::uint32_t> indices;
    Elements values;
};

Result<Replacements> read_replacements(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                                       std::size_t element_bytes) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0 ||
        !is_index_type(sparse.indices.componentType)) {
        return fail(Fault::bad_input, "accessor '{}' has a broken sparse part", accessor.name);
    }
    const auto count = static_cast<std::size_t>(sparse.count);
    const auto where = locate(model, {sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                                      component_bytes(sparse.indices.componentType)});
    if (!where) return where.error();
    const auto values =
        locate(model, {sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count, element_bytes});
    if (!values) return values.error();
    Replacements replacements{{}, *values};
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t index = index_value(where->bytes.data() + i * where->stride, sparse.indices.componentType);
        if (index >= accessor.count) {
            return fail(Fault::bad_input, "a sparse accessor replaces element {} of {}", index, accessor.count);
        }
        replacements.indices.push_back(index);
    }
    return replacements;
}

}  // namespace

std::uint32_t component_count(const tinygltf::Model& model, int accessor) {
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size()) return 0;
    switch (model.accessors[static_cast<std::size_t>(accessor)].type) {
        case TINYGLTF_TYPE_SCALAR:
            return 1;
        case TINYGLTF_TYPE_VEC2:
            return 2;
        case TINYGLTF_TYPE_VEC3:
            return 3;
        case TINYGLTF_TYPE_VEC4:
            return 4;
        default:
            return 0;  // matrices have column padding and no place in a vertex
    }
}

Result<std::vector<float>> read_floats(const tinygltf::Model& model, int index, std::uint32_t components) {
    const auto found = find_accessor(model, index, components);
    if (!found) return found.error();
    const tinygltf::Accessor& accessor = **found;
    const std::size_t element_bytes = component_bytes(accessor.componentType) * components;
    Elements base;
    if (accessor.bufferView >= 0) {
        const auto located = locate(model, {accessor.bufferView, accessor.byteOffset, accessor.count, element_bytes});
        if (!located) return fail(Fault::bad_input, "accessor {}: {}", index, located.error().sentence);
        base = *located;
    }
    std::vector<float> values(accessor.count * components, 0.0f);
    unpack(base, accessor, components, values);
    if (!accessor.sparse.isSparse) return values;

    const auto replaced = read_replacements(model, accessor, element_bytes);
    if (!replaced) return fail(Fault::bad_input, "accessor {}: {}", index, replaced.error().sentence);
    std::vector<float> fresh(replaced->indices.size() * components);
    unpack(replaced->values, accessor, components, fresh);
    for (std::size_t i = 0; i < replaced->indices.size(); ++i) {
        std::copy_n(&fresh[i * components], components, &values[std::size_t{replaced->indices[i]} * components]);
    }
    return values;
}

Result<std::vector<std::uint32_t>> read_indices(const tinygltf::Model& model, int index) {
    const auto found = find_accessor(model, index, 1);
    if (!found) return found.error();
    const tinygltf::Accessor& accessor = **found;
    if (!is_index_type(accessor.componentType) || accessor.sparse.isSparse) {
        return fail(Fault::bad_input, "accessor {} holds no plain unsigned indices", index);
    }
    const auto located =
        locate(model, {accessor.bufferView, accessor.byteOffset, accessor.count, component_bytes(accessor.componentType)});
    if (!located) return fail(Fault::bad_input, "accessor {}: {}", index, located.error().sentence);
    std::vector<std::uint32_t> indices(located->count);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        indices[i] = index_value(located->bytes.data() + i * located->stride, accessor.componentType);
    }
    return indices;
}

Result<std::vector<unsigned char>> read_view(const tinygltf::Model& model, int buffer_view) {
    const auto bytes = view_bytes(model, buffer_view);
    if (!bytes) return bytes.error();
    return std::vector<unsigned char>(bytes->begin(), bytes->end());
}

}  // namespace strata::gltf
