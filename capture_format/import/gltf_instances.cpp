#include "capture_format/import/gltf_instances.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/gtc/quaternion.hpp>

#include "capture_format/import/gltf_accessors.h"
#include "capture_format/import/gltf_check.h"

namespace strata::gltf {
namespace {

/// What the extension's text allows of an attribute.
struct AttributeType {
    const char* name;
    std::uint32_t components;
    bool may_be_normalized;  ///< as signed bytes or shorts
};
constexpr AttributeType translation = {"TRANSLATION", 3, false}, rotation = {"ROTATION", 4, true}, scale = {"SCALE", 3, false};

/// Values of one attribute; empty when the node has none.
Result<std::vector<float>> read_attribute(const Document& document, const Node& node, const AttributeType& type,
                                          MemoryBudget& budget) {
    const auto found = node.instances.find(type.name);
    if (found == node.instances.end()) return std::vector<float>();
    auto values = read_floats(document, found->second, type.components, budget);
    if (!values) return within(values.error(), "{attribute}", type.name);
    const Accessor& accessor = document.accessors[static_cast<std::size_t>(found->second)];
    const bool is_signed = accessor.component_type == int8 || accessor.component_type == int16;
    if (accessor.component_type != float32 && !(type.may_be_normalized && is_signed && accessor.normalized)) {
        return within(not_floats(accessor.component_type, type.may_be_normalized ? " or normalized signed bytes or shorts" : ""),
                      "{attribute}", type.name);
    }
    if (!std::all_of(values->begin(), values->end(), [](float value) { return std::isfinite(value); }))
        return within(not_finite(), "{attribute}", type.name);
    return values;
}

/// How many instances all attributes together say there are, those of applications (_ID) among them.
Result<std::size_t> count_instances(const Document& document, const Node& node) {
    std::optional<std::uint64_t> count;
    for (const auto& [name, index] : node.instances) {
        if (index < 0 || static_cast<std::size_t>(index) >= document.accessors.size())
            return within(no_such("accessor", index, document.accessors.size()), "{attribute}", name);
        const std::uint64_t here = document.accessors[static_cast<std::size_t>(index)].count;
        if (count.value_or(here) != here)
            return fail(Fault::bad_input, "import.gltf.attribute_count",
                        "{attribute} has {elements} elements; other attributes have {wanted}", name, here, *count);
        count = here;
    }
    if (!count) return fail(Fault::bad_input, "import.gltf.no_instance_attributes", "EXT_mesh_gpu_instancing has no attributes");
    return static_cast<std::size_t>(*count);
}

Result<std::vector<glm::dmat4>> read_matrices(const Document& document, const Node& node, MemoryBudget& budget) {
    const auto count = count_instances(document, node);
    if (!count) return count.error();
    if (const auto room = budget.take(*count, sizeof(glm::dmat4), "its instances"); !room) return room.error();
    const auto moves = read_attribute(document, node, translation, budget);
    const auto turns = read_attribute(document, node, rotation, budget);
    const auto sizes = read_attribute(document, node, scale, budget);
    for (const auto* read : {&moves, &turns, &sizes})
        if (!*read) return read->error();
    std::vector<glm::dmat4> matrices(*count, glm::dmat4(1));
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        glm::dmat4& matrix = matrices[i];
        if (!turns->empty()) {
            const auto* q = &(*turns)[i * 4];
            const glm::dquat turn(double{q[3]}, double{q[0]}, double{q[1]}, double{q[2]});
            if (glm::length(turn) > 0) matrix = glm::mat4_cast(glm::normalize(turn));
        }
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t at = i * 3 + static_cast<std::size_t>(axis);
            if (!sizes->empty()) matrix[axis] *= double{(*sizes)[at]};
            if (!moves->empty()) matrix[3][axis] = double{(*moves)[at]};
        }
    }
    return matrices;
}

}  // namespace

Result<std::vector<glm::dmat4>> read_instances(const Document& document, const Node& node, MemoryBudget& budget) {
    if (!node.is_instanced) return std::vector<glm::dmat4>{glm::dmat4(1)};
    auto matrices = read_matrices(document, node, budget);
    if (!matrices) return within(matrices.error(), "instances of node '{node:.60}'", node.name);
    return matrices;
}

}  // namespace strata::gltf
