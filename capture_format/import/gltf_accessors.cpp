#include "capture_format/import/gltf_accessors.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <string_view>

#include "capture_format/import/gltf_check.h"

namespace strata::gltf {
namespace {

/// Where elements of one kind lie: element i begins at bytes[i * stride].
struct Elements {
    std::span<const std::byte> bytes;
    std::size_t stride = 0, count = 0;
};

struct Layout {
    int view = -1;
    std::uint64_t offset = 0, count = 0, element_bytes = 0;
};

Result<Elements> locate(const Document& document, const Layout& layout) {
    if (layout.view < 0 || static_cast<std::size_t>(layout.view) >= document.views.size()) {
        return no_such("buffer view", layout.view, document.views.size());
    }
    const BufferView& view = document.views[static_cast<std::size_t>(layout.view)];
    if (view.content.fault) return *view.content.fault;
    const std::size_t stride = view.stride == 0 ? layout.element_bytes : view.stride;
    if (layout.count == 0) return Elements{{}, stride, 0};
    const std::size_t length = view.content.bytes.size();
    const bool inside = stride >= layout.element_bytes && layout.offset <= length &&
                        length - layout.offset >= layout.element_bytes &&
                        layout.count - 1 <= (length - layout.offset - layout.element_bytes) / stride;
    if (!inside) {
        return fail(Fault::bad_input, "import.gltf.accessor_range",
                    "the accessor needs {elements} elements x {element_bytes} bytes (stride {stride}, offset {offset}), beyond "
                    "the end of buffer view {view} ({view_bytes} bytes)",
                    layout.count, layout.element_bytes, stride, layout.offset, layout.view, length);
    }
    return Elements{view.content.bytes.subspan(layout.offset), stride, layout.count};
}

template <typename T>
T load(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));  // unaligned in hostile files; glTF is little-endian like every host we build on
    return value;
}

/// glTF 2.0, 3.6.2.2: signed normalized integers map their lowest value to -1 as well.
float component(const std::byte* bytes, std::uint64_t type, bool normalized) {
    switch (type) {
        case int8: {
            const float value = load<std::int8_t>(bytes);
            return normalized ? std::max(value / 127.0f, -1.0f) : value;
        }
        case uint8:
            return static_cast<float>(load<std::uint8_t>(bytes)) / (normalized ? 255.0f : 1.0f);
        case int16: {
            const float value = load<std::int16_t>(bytes);
            return normalized ? std::max(value / 32767.0f, -1.0f) : value;
        }
        case uint16:
            return static_cast<float>(load<std::uint16_t>(bytes)) / (normalized ? 65535.0f : 1.0f);
        case uint32: {
            const auto value = static_cast<double>(load<std::uint32_t>(bytes));
            return static_cast<float>(normalized ? value / 4294967295.0 : value);
        }
        default:
            return load<float>(bytes);
    }
}

std::uint32_t index_value(const std::byte* bytes, std::uint64_t type) {
    switch (type) {
        case uint8:
            return load<std::uint8_t>(bytes);
        case uint16:
            return load<std::uint16_t>(bytes);
        default:
            return load<std::uint32_t>(bytes);
    }
}

/// 0 for types that do not exist.
std::size_t component_bytes(std::uint64_t type) {
    switch (type) {
        case int8:
        case uint8:
            return 1;
        case int16:
        case uint16:
            return 2;
        case uint32:
        case float32:
            return 4;
        default:
            return 0;
    }
}

bool is_index_type(std::uint64_t type) { return type == uint8 || type == uint16 || type == uint32; }

std::uint32_t components_of(std::string_view type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4") return 4;
    return type == "MAT4" ? 16 : 0;  // smaller matrices pad their columns, and nothing that we read has one
}

Result<const Accessor*> find_accessor(const Document& document, int index, std::uint32_t components) {
    if (index < 0 || static_cast<std::size_t>(index) >= document.accessors.size()) {
        return no_such("accessor", index, document.accessors.size());
    }
    const Accessor& accessor = document.accessors[static_cast<std::size_t>(index)];
    if (components_of(accessor.type) != components) {
        return fail(Fault::bad_input, "import.gltf.accessor_type",
                    "accessor {accessor} is a '{type:.20}', which does not have {components} components", index, accessor.type,
                    components);
    }
    if (component_bytes(accessor.component_type) == 0) {
        return fail(Fault::bad_input, "import.gltf.component_type",
                    "accessor {accessor} has unknown component type {component_type}", index, accessor.component_type);
    }
    return &accessor;
}

/// The elements a sparse accessor replaces: element `values`[i] goes to place `places`[i].
struct Replacements {
    std::vector<std::uint32_t> places;
    Elements values;
};

Result<Replacements> read_replacements(const Document& document, const Accessor& accessor, std::size_t element_bytes,
                                       MemoryBudget& budget) {
    const Sparse& sparse = *accessor.sparse;
    if (!is_index_type(sparse.indices_type)) {
        return fail(Fault::bad_input, "import.gltf.sparse_index_type",
                    "the sparse indices have component type {component_type}, which is not an unsigned integer",
                    sparse.indices_type);
    }
    if (sparse.count > accessor.count) {
        return fail(Fault::bad_input, "import.gltf.sparse_count",
                    "the sparse accessor replaces {replaced} of its {elements} elements", sparse.count, accessor.count);
    }
    const auto where =
        locate(document, {sparse.indices_view, sparse.indices_offset, sparse.count, component_bytes(sparse.indices_type)});
    if (!where) return where.error();
    const auto values = locate(document, {sparse.values_view, sparse.values_offset, sparse.count, element_bytes});
    if (!values) return values.error();
    if (const auto room = budget.take(where->count, 4, "a sparse accessor"); !room) return room.error();
    Replacements replacements{{}, *values};
    replacements.places.reserve(where->count);
    for (std::size_t i = 0; i < where->count; ++i) {
        replacements.places.push_back(index_value(where->bytes.data() + i * where->stride, sparse.indices_type));
        if (replacements.places.back() >= accessor.count) {
            return fail(Fault::bad_input, "import.gltf.sparse_range",
                        "the sparse accessor replaces element {element} of {elements}", replacements.places.back(),
                        accessor.count);
        }
    }
    return replacements;
}

/// Calls put(place, bytes) for every element that has bytes, replaced ones last; the others are zero.
template <typename Put>
Result<void> for_each_element(const Document& document, const Accessor& accessor, MemoryBudget& budget, const Put& put) {
    const std::size_t element_bytes = component_bytes(accessor.component_type) * components_of(accessor.type);
    if (accessor.view >= 0) {
        const auto base = locate(document, {accessor.view, accessor.offset, accessor.count, element_bytes});
        if (!base) return base.error();
        for (std::size_t i = 0; i < base->count; ++i) put(i, base->bytes.data() + i * base->stride);
    }
    if (!accessor.sparse) return {};
    const auto replaced = read_replacements(document, accessor, element_bytes, budget);
    if (!replaced) return replaced.error();
    for (std::size_t i = 0; i < replaced->places.size(); ++i) {
        put(replaced->places[i], replaced->values.bytes.data() + i * replaced->values.stride);
    }
    return {};
}

/// Unpacked bytes of the file and all that it refers to.
std::uint64_t bytes_of(const Document& document) {
    std::uint64_t sum = 0;
    for (const std::vector<std::byte>& bytes : document.storage) sum += bytes.size();
    return sum;
}

/// An accessor that claims more than its buffer view holds is told so before anything is allocated for it. Without a view all its
/// elements are 0, and a few bytes can claim any number: there are not more than the file has bytes.
Result<void> check_claim(const Document& document, const Accessor& accessor, std::uint64_t element_bytes, MemoryBudget& budget) {
    if (accessor.view >= 0) {
        const auto base = locate(document, {accessor.view, accessor.offset, accessor.count,
                                            component_bytes(accessor.component_type) * components_of(accessor.type)});
        if (!base) return base.error();
    }
    if (const std::uint64_t most = bytes_of(document); accessor.view < 0 && accessor.count > most) {
        return fail(Fault::bad_input, "import.gltf.accessor_without_view",
                    "it has {elements} elements and no buffer view; the file and its buffers have {bytes} bytes", accessor.count,
                    most);
    }
    return budget.take(accessor.count, element_bytes, "its elements");
}

}  // namespace

std::uint32_t component_count(const Document& document, int accessor) {
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= document.accessors.size()) return 0;
    return components_of(document.accessors[static_cast<std::size_t>(accessor)].type);
}

Result<std::vector<float>> read_floats(const Document& document, int index, std::uint32_t components, MemoryBudget& budget) {
    const auto found = find_accessor(document, index, components);
    if (!found) return found.error();
    const Accessor& accessor = **found;
    if (const auto good = check_claim(document, accessor, sizeof(float) * components, budget); !good) {
        return within(good.error(), "accessor {accessor}", index);
    }
    const std::size_t size = component_bytes(accessor.component_type);
    std::vector<float> values(accessor.count * components, 0.0f);
    const auto read = for_each_element(document, accessor, budget, [&](std::size_t place, const std::byte* bytes) {
        for (std::uint32_t c = 0; c < components; ++c) {
            values[place * components + c] = component(bytes + c * size, accessor.component_type, accessor.normalized);
        }
    });
    if (!read) return within(read.error(), "accessor {accessor}", index);
    return values;
}

Result<std::vector<std::uint32_t>> read_indices(const Document& document, int index, MemoryBudget& budget) {
    const auto found = find_accessor(document, index, 1);
    if (!found) return found.error();
    const Accessor& accessor = **found;
    if (!is_index_type(accessor.component_type))
        return fail(Fault::bad_input, "import.gltf.index_type", "accessor {accessor} does not hold unsigned integers", index);
    if (const auto good = check_claim(document, accessor, sizeof(std::uint32_t), budget); !good) {
        return within(good.error(), "accessor {accessor}", index);
    }
    std::vector<std::uint32_t> indices(accessor.count, 0);
    const auto read = for_each_element(document, accessor, budget, [&](std::size_t place, const std::byte* bytes) {
        indices[place] = index_value(bytes, accessor.component_type);
    });
    if (!read) return within(read.error(), "accessor {accessor}", index);
    const std::uint32_t restart = 0xffffffffu >> (32 - 8 * component_bytes(accessor.component_type));
    const auto found_restart = std::find(indices.begin(), indices.end(), restart);
    if (found_restart != indices.end()) {
        return fail(
            Fault::bad_input, "import.gltf.restart_index",
            "element {element} of accessor {accessor} is {index}, which would restart the primitive; glTF does not allow it: "
            "split the primitive there",
            found_restart - indices.begin(), index, restart);
    }
    return indices;
}

}  // namespace strata::gltf
