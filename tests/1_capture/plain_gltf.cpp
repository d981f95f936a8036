#include "tests/1_capture/plain_gltf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include <nlohmann/json.hpp>

namespace strata {
namespace {

using Json = nlohmann::json;
using Point = std::array<double, 3>;
/// Column by column, as glTF stores it.
using Matrix = std::array<double, 16>;
constexpr Matrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

std::vector<unsigned char> from_base64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned char> bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char letter : text) {
        if (letter == '=') break;
        bits = bits << 6 | static_cast<unsigned>(digits.find(letter));
        count += 6;
        if (count >= 8) bytes.push_back(static_cast<unsigned char>(bits >> (count -= 8) & 255u));
    }
    return bytes;
}

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix result{};
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t k = 0; k < 4; ++k) result[column * 4 + row] += a[k * 4 + row] * b[column * 4 + k];
    return result;
}

Point moved(const Matrix& m, const Point& p) {
    Point result{};
    for (std::size_t row = 0; row < 3; ++row) result[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
    return result;
}

/// Scale, then the unit quaternion x y z w, then translation.
Matrix composed(const std::vector<double>& t, const std::vector<double>& q, const std::vector<double>& s) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double x = q[0] / length, y = q[1] / length, z = q[2] / length, w = q[3] / length;
    const double turn[9] = {1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
                            2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
                            2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y)};
    Matrix result = identity;
    for (std::size_t column = 0; column < 3; ++column)
        for (std::size_t row = 0; row < 3; ++row) result[column * 4 + row] = turn[column * 3 + row] * s[column];
    for (std::size_t row = 0; row < 3; ++row) result[12 + row] = t[row];
    return result;
}

template <typename T>
double loaded(const unsigned char* bytes, double largest) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return largest == 0 ? static_cast<double>(value) : std::max(static_cast<double>(value) / largest, -1.0);
}

class PlainReader {
public:
    explicit PlainReader(const std::string& text) : root_(Json::parse(text)) {
        for (const Json& buffer : root_.value("buffers", Json::array())) {
            const std::string uri = buffer["uri"];
            buffers_.push_back(from_base64(uri.substr(uri.find(',') + 1)));
        }
    }

    TriangleMeasures run() {
        const Json nodes = root_.value("nodes", Json::array());
        std::vector<std::size_t> roots;
        if (root_.contains("scenes")) {
            roots = root_["scenes"][root_.value("scene", 0u)].value("nodes", roots);
        } else {
            std::vector<bool> is_child(nodes.size());
            for (const Json& node : nodes)
                for (const std::size_t child : node.value("children", std::vector<std::size_t>())) is_child[child] = true;
            for (std::size_t i = 0; i < nodes.size(); ++i)
                if (!is_child[i]) roots.push_back(i);
        }
        for (const std::size_t node : roots) visit(nodes, node, identity);
        return measures_;
    }

private:
    static std::size_t component_bytes(int type) {
        return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4;
    }

    static double component(const unsigned char* bytes, int type, bool normalized) {
        switch (type) {
            case 5120:
                return loaded<std::int8_t>(bytes, normalized ? 127 : 0);
            case 5121:
                return loaded<std::uint8_t>(bytes, normalized ? 255 : 0);
            case 5122:
                return loaded<std::int16_t>(bytes, normalized ? 32767 : 0);
            case 5123:
                return loaded<std::uint16_t>(bytes, normalized ? 65535 : 0);
            case 5125:
                return loaded<std::uint32_t>(bytes, 0);
            default:
                return loaded<float>(bytes, 0);
        }
    }

    /// Where byte `offset` of a buffer view is.
    const unsigned char* at(std::size_t view, std::size_t offset) const {
        const Json& where = root_["bufferViews"][view];
        return buffers_[where["buffer"]].data() + where.value("byteOffset", std::size_t{0}) + offset;
    }

    std::vector<double> values(std::size_t index) const {
        const Json& accessor = root_["accessors"][index];
        const std::string kind = accessor["type"];
        const std::size_t width = kind == "SCALAR" ? 1 : kind == "VEC2" ? 2 : kind == "VEC3" ? 3 : 4;
        const std::size_t count = static_cast<std::size_t>(accessor["count"].get<double>());
        const int type = accessor["componentType"];
        const bool normalized = accessor.value("normalized", false);
        const std::size_t size = component_bytes(type);
        std::vector<double> result(count * width, 0.0);
        if (accessor.contains("bufferView")) {
            const std::size_t view = accessor["bufferView"], offset = accessor.value("byteOffset", std::size_t{0});
            const std::size_t stride = root_["bufferViews"][view].value("byteStride", size * width);
            for (std::size_t i = 0; i < result.size(); ++i)
                result[i] = component(at(view, offset + i / width * stride + i % width * size), type, normalized);
        }
        if (!accessor.contains("sparse")) return result;
        const Json &sparse = accessor["sparse"], &indices = sparse["indices"], &fresh = sparse["values"];
        const int index_type = indices["componentType"];
        for (std::size_t i = 0; i < sparse["count"]; ++i) {
            const auto place = static_cast<std::size_t>(component(
                at(indices["bufferView"], indices.value("byteOffset", std::size_t{0}) + i * component_bytes(index_type)),
                index_type, false));
            for (std::size_t c = 0; c < width; ++c)
                result[place * width + c] =
                    component(at(fresh["bufferView"], fresh.value("byteOffset", std::size_t{0}) + (i * width + c) * size), type,
                              normalized);
        }
        return result;
    }

    void visit(const Json& nodes, std::size_t index, const Matrix& parent) {
        const Json& node = nodes[index];
        Matrix local = identity;
        if (node.contains("matrix")) {
            local = node["matrix"];
        } else {
            local = composed(node.value("translation", std::vector<double>{0, 0, 0}),
                             node.value("rotation", std::vector<double>{0, 0, 0, 1}),
                             node.value("scale", std::vector<double>{1, 1, 1}));
        }
        const Matrix world = product(parent, local);
        if (node.contains("mesh"))
            for (const Matrix& instance : instances(node)) add_mesh(node, product(world, instance));
        for (const std::size_t child : node.value("children", std::vector<std::size_t>())) visit(nodes, child, world);
    }

    std::vector<Matrix> instances(const Json& node) const {
        const Json extensions = node.value("extensions", Json::object());
        if (!extensions.contains("EXT_mesh_gpu_instancing")) return {identity};
        const Json& attributes = extensions["EXT_mesh_gpu_instancing"]["attributes"];
        const std::size_t count = root_["accessors"][attributes.begin()->get<std::size_t>()]["count"];
        std::vector<double> t(count * 3, 0.0), q, s(count * 3, 1.0);
        for (std::size_t i = 0; i < count; ++i) q.insert(q.end(), {0, 0, 0, 1});
        if (attributes.contains("TRANSLATION")) t = values(attributes["TRANSLATION"]);
        if (attributes.contains("ROTATION")) q = values(attributes["ROTATION"]);
        if (attributes.contains("SCALE")) s = values(attributes["SCALE"]);
        std::vector<Matrix> result;
        for (std::size_t i = 0; i < count; ++i)
            result.push_back(composed({t[i * 3], t[i * 3 + 1], t[i * 3 + 2]},
                                      {q[i * 4], q[i * 4 + 1], q[i * 4 + 2], q[i * 4 + 3]},
                                      {s[i * 3], s[i * 3 + 1], s[i * 3 + 2]}));
        return result;
    }

    void add_mesh(const Json& node, const Matrix& world) {
        const Json& mesh = root_["meshes"][node["mesh"].get<std::size_t>()];
        const std::vector<double> weights = node.value("weights", mesh.value("weights", std::vector<double>()));
        for (const Json& primitive : mesh["primitives"]) {
            std::vector<double> positions = values(primitive["attributes"]["POSITION"]);
            const Json targets = primitive.value("targets", Json::array());
            for (std::size_t target = 0; target < std::min(targets.size(), weights.size()); ++target) {
                const std::vector<double> moves = values(targets[target]["POSITION"]);
                for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += weights[target] * moves[i];
            }
            std::vector<double> order;
            if (primitive.contains("indices")) order = values(primitive["indices"]);
            else
                for (std::size_t i = 0; i < positions.size() / 3; ++i) order.push_back(static_cast<double>(i));
            add_triangles(positions, order, primitive.value("mode", 4), world);
        }
    }

    void add_triangles(const std::vector<double>& positions, const std::vector<double>& order, int mode, const Matrix& world) {
        if (mode < 4) return;
        const auto corner = [&](std::size_t i) {
            const std::size_t first = static_cast<std::size_t>(order[i]) * 3;
            return moved(world, {positions[first], positions[first + 1], positions[first + 2]});
        };
        for (std::size_t i = 0; i + 2 < order.size(); i += mode == 4 ? 3 : 1)
            measures_.add({corner(mode == 6 ? 0 : i), corner(i + 1), corner(i + 2)});
    }

    const Json root_;
    std::vector<std::vector<unsigned char>> buffers_;
    TriangleMeasures measures_;
};

}  // namespace

void TriangleMeasures::add(const std::array<Point, 3>& corners) {
    ++triangles;
    Point a{}, b{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        a[axis] = corners[1][axis] - corners[0][axis];
        b[axis] = corners[2][axis] - corners[0][axis];
        for (const Point& corner : corners) {
            low[axis] = std::min(low[axis], corner[axis]);
            high[axis] = std::max(high[axis], corner[axis]);
        }
    }
    area += std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]) / 2;
}

TriangleMeasures measure_plainly(const std::string& gltf) { return PlainReader(gltf).run(); }

}  // namespace strata
