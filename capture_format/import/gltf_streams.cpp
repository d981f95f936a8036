#include "capture_format/import/gltf_streams.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "capture_format/import/gltf_accessors.h"
#include "capture_format/import/gltf_check.h"

namespace strata::gltf {
namespace {

/// What a vertex takes once normals, tangents, uvs and color are there, and an index. Both are there four times while a frame is
/// recorded: kept for the next frame, in the frame, in the recorder's blobs, compressed or on the device.
constexpr std::uint64_t bytes_per_vertex = 4 * 76, bytes_per_index = 4 * 4;

bool all_finite(std::span<const float> values) {
    return std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}

template <typename Vector>
std::vector<Vector> packed(std::span<const float> values) {
    std::vector<Vector> vectors(values.size() / Vector::length());
    for (std::size_t i = 0; i < values.size(); ++i) {
        vectors[i / Vector::length()][static_cast<int>(i % Vector::length())] = values[i];
    }
    return vectors;
}

/// Triangle lists, strips and fans as triples; the odd triangles of a strip turn around (glTF 2.0, 3.7.2.1).
std::vector<std::uint32_t> triangles(std::span<const std::uint32_t> order, std::uint64_t mode) {
    std::vector<std::uint32_t> triples;
    const std::size_t step = mode == triangle_list ? 3 : 1;
    triples.reserve(order.size() / step * 3);
    for (std::size_t i = 0; i + 2 < order.size(); i += step) {
        if (mode == triangle_fan) {
            triples.insert(triples.end(), {order[i + 1], order[i + 2], order[0]});
        } else if (mode == triangle_strip && i % 2 == 1) {
            triples.insert(triples.end(), {order[i], order[i + 2], order[i + 1]});
        } else {
            triples.insert(triples.end(), {order[i], order[i + 1], order[i + 2]});
        }
    }
    return triples;
}

class StreamReader {
public:
    StreamReader(const Document& document, const Primitive& primitive, MemoryBudget& budget)
        : document_(document), primitive_(primitive), budget_(budget) {}

    Result<Streams> run() {
        read_positions();
        read_triangles();
        Mesh& mesh = streams_.mesh;
        mesh.normals = stream<glm::vec3>(primitive_.attributes, "NORMAL");
        mesh.tangents = stream<glm::vec4>(primitive_.attributes, "TANGENT");
        mesh.uv0 = stream<glm::vec2>(primitive_.attributes, "TEXCOORD_0");
        mesh.uv1 = stream<glm::vec2>(primitive_.attributes, "TEXCOORD_1");
        read_colors();
        for (const Attributes& target : primitive_.targets) read_target(target);
        read_influences();
        if (problem_) return *problem_;
        return std::move(streams_);
    }

private:
    static int accessor_of(const Attributes& attributes, const std::string& name) {
        const auto found = attributes.find(name);
        return found == attributes.end() ? -1 : found->second;
    }

    void refuse(Error error) {
        if (!problem_) problem_ = std::move(error);
    }

    /// As many elements as there are positions; empty when it is missing or, with a warning, of no use.
    template <typename Vector>
    std::vector<Vector> stream(const Attributes& attributes, const std::string& name) {
        const int accessor = accessor_of(attributes, name);
        if (accessor < 0 || problem_) return {};
        const auto values = read_floats(document_, accessor, static_cast<std::uint32_t>(Vector::length()), budget_);
        if (!values) {
            refuse(within(values.error(), "{attribute}", name));
            return {};
        }
        const std::size_t count = values->size() / Vector::length(), wanted = streams_.mesh.positions.size();
        if (count != wanted) {
            refuse(fail(Fault::bad_input, "import.gltf.attribute_count",
                        "{attribute} has {elements} elements; other attributes have {wanted}", name, count, wanted));
            return {};
        }
        if (all_finite(*values)) return packed<Vector>(*values);
        streams_.warnings.push_back(fmt::format("{} is left out: it holds numbers that are not finite", name));
        return {};
    }

    void read_positions() {
        const auto values = read_floats(document_, accessor_of(primitive_.attributes, "POSITION"), 3, budget_);
        if (!values) return refuse(within(values.error(), "{attribute}", "POSITION"));
        if (!all_finite(*values)) return refuse(within(not_finite(), "{attribute}", "POSITION"));
        streams_.mesh.positions = packed<glm::vec3>(*values);
    }

    void read_triangles() {
        if (primitive_.mode != triangle_list && primitive_.mode != triangle_strip && primitive_.mode != triangle_fan) {
            streams_.warnings.emplace_back("points and lines are ignored");
            return;
        }
        const std::size_t vertices = streams_.mesh.positions.size();
        std::vector<std::uint32_t> order(primitive_.indices >= 0 ? 0 : vertices);
        std::iota(order.begin(), order.end(), 0u);
        if (primitive_.indices >= 0) {
            auto indices = read_indices(document_, primitive_.indices, budget_);
            if (!indices) return refuse(indices.error());
            order = *std::move(indices);
        }
        const auto beyond = std::find_if(order.begin(), order.end(), [&](std::uint32_t index) { return index >= vertices; });
        if (beyond != order.end()) {
            return refuse(fail(Fault::bad_input, "import.gltf.vertex_range", "a triangle uses vertex {vertex} of {vertices}",
                               *beyond, vertices));
        }
        // each corner of a strip may become three; without normals each of them is a vertex of its own
        const std::uint64_t corners = order.size() * (primitive_.mode == triangle_list ? 1 : 3);
        const std::uint64_t kept = primitive_.attributes.contains("NORMAL") ? vertices : corners;
        if (const auto room = budget_.take(kept, bytes_per_vertex, "its vertices"); !room) return refuse(room.error());
        if (const auto room = budget_.take(corners, bytes_per_index, "its triangles"); !room) return refuse(room.error());
        streams_.mesh.indices = triangles(order, primitive_.mode);
    }

    void read_colors() {
        if (component_count(document_, accessor_of(primitive_.attributes, "COLOR_0")) != 3) {
            streams_.mesh.colors = stream<glm::vec4>(primitive_.attributes, "COLOR_0");
            return;
        }
        for (const glm::vec3& color : stream<glm::vec3>(primitive_.attributes, "COLOR_0")) {
            streams_.mesh.colors.emplace_back(color, 1.0f);
        }
    }

    void read_target(const Attributes& attributes) {
        streams_.targets.push_back({stream<glm::vec3>(attributes, "POSITION"), stream<glm::vec3>(attributes, "NORMAL"),
                                    stream<glm::vec3>(attributes, "TANGENT")});
        const bool more = std::any_of(attributes.begin(), attributes.end(), [](const auto& attribute) {
            return attribute.first != "POSITION" && attribute.first != "NORMAL" && attribute.first != "TANGENT";
        });
        if (more) streams_.warnings.emplace_back("morph targets move positions, normals and tangents only; the rest is ignored");
    }

    /// All sets of joints, one vertex after another.
    void read_influences() {
        std::vector<std::vector<glm::vec4>> joints, weights;
        while (accessor_of(primitive_.attributes, fmt::format("JOINTS_{}", joints.size())) >= 0 && !problem_) {
            const std::string set = std::to_string(joints.size());
            joints.push_back(stream<glm::vec4>(primitive_.attributes, "JOINTS_" + set));
            weights.push_back(stream<glm::vec4>(primitive_.attributes, "WEIGHTS_" + set));
            if (weights.back().size() != joints.back().size() && !problem_) {
                refuse(fail(Fault::bad_input, "import.gltf.joints_without_weights", "JOINTS_{set} has no usable weights", set));
            }
        }
        if (problem_ || joints.empty()) return;
        streams_.influences = joints.size() * 4;
        for (std::size_t vertex = 0; vertex < streams_.mesh.positions.size(); ++vertex) {
            double sum = 0;
            for (const auto& set : weights) {
                for (int i = 0; i < 4; ++i) sum += static_cast<double>(std::max(set[vertex][i], 0.0f));
            }
            for (std::size_t set = 0; set < joints.size(); ++set) {
                for (int i = 0; i < 4; ++i) add_influence(joints[set][vertex][i], weights[set][vertex][i], sum);
            }
        }
    }

    void add_influence(float joint, float weight, double sum) {
        const bool moves = weight > 0;
        if (moves && !(joint >= 0 && joint <= 65535))
            return refuse(fail(Fault::bad_input, "import.gltf.joint", "{joint} is not the index of a joint", joint));
        const auto index = moves ? static_cast<std::uint32_t>(joint) : 0;
        streams_.joints.push_back(index);
        streams_.weights.push_back(moves ? static_cast<float>(static_cast<double>(weight) / sum) : 0.0f);
        if (moves) streams_.joint_end = std::max(streams_.joint_end, index + 1);
    }

    const Document& document_;
    const Primitive& primitive_;
    MemoryBudget& budget_;
    Streams streams_;
    std::optional<Error> problem_;
};

}  // namespace

Result<Streams> read_streams(const Document& document, const Primitive& primitive, MemoryBudget& budget) {
    return StreamReader(document, primitive, budget).run();
}

}  // namespace strata::gltf
