#include "capture_format/export/gltf_parts.h"

#include <algorithm>
#include <cmath>

namespace strata::to_gltf_parts {
namespace {

constexpr int float_component = 5126, uint_component = 5125;

}  // namespace

std::size_t Parts::add(const char* list, Json element) {
    root[list].push_back(std::move(element));
    return root[list].size() - 1;
}

std::size_t Parts::add_view(std::span<const std::byte> bytes) {
    const std::size_t offset = binary.size();
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    binary.resize((binary.size() + 3) / 4 * 4);
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

std::size_t Parts::add_floats(std::span<const float> values, const char* type, std::size_t components) {
    std::vector<float> finite(values.begin(), values.end());
    for (float& value : finite) {
        if (std::isfinite(value)) continue;
        value = 0;
        ++not_finite;
    }
    Json low = Json::array(), high = Json::array();  // glTF demands them of positions
    for (std::size_t c = 0; c < components && !finite.empty(); ++c) {
        float least = finite[c], most = finite[c];
        for (std::size_t i = c; i < finite.size(); i += components) {
            least = std::min(least, finite[i]);
            most = std::max(most, finite[i]);
        }
        low.push_back(least);
        high.push_back(most);
    }
    Json accessor = {{"bufferView", add_view(std::as_bytes(std::span(finite)))},
                     {"componentType", float_component},
                     {"type", type},
                     {"count", finite.size() / components}};
    if (!low.empty()) accessor.update({{"min", low}, {"max", high}});
    return add("accessors", std::move(accessor));
}

std::size_t Parts::add_indices(std::span<const std::uint32_t> indices) {
    return add("accessors", {{"bufferView", add_view(std::as_bytes(indices))},
                             {"componentType", uint_component},
                             {"type", "SCALAR"},
                             {"count", indices.size()}});
}

void Parts::use(const std::string& extension) {
    Json& used = root["extensionsUsed"];
    if (!used.has_text(extension)) used.push_back(extension);
}

}  // namespace strata::to_gltf_parts
