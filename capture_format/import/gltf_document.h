// A glTF 2.0 file as plain values: everything the import reads, nothing it does not. Numbers are as the file says; whoever
// follows an index checks that it leads somewhere. Bytes of buffers stay where they were loaded, views point into them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "capture_format/import/gltf_material_source.h"

namespace strata::gltf {

/// Bytes that may turn out not to be there: then `fault` says why, and only who needs them fails.
struct Bytes {
    std::span<const std::byte> bytes;
    std::optional<Error> fault = {};
};

struct BufferView {
    Bytes content;
    std::size_t stride = 0;  ///< 0: elements lie packed
};

/// glTF's own numbers of component types.
enum ComponentType : std::uint64_t { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

struct Sparse {
    std::uint64_t count = 0, indices_offset = 0, indices_type = 0, values_offset = 0;
    int indices_view = -1, values_view = -1;
};

struct Accessor {
    int view = -1;  ///< -1: zeros, before the sparse replacements
    std::uint64_t offset = 0, count = 0, component_type = 0;
    std::string type;  ///< "VEC3"
    bool normalized = false;
    std::optional<Sparse> sparse;
};

enum PrimitiveMode : std::uint64_t { triangle_list = 4, triangle_strip = 5, triangle_fan = 6 };
using Attributes = std::map<std::string, int>;  ///< accessors by semantic: POSITION, JOINTS_0

struct Primitive {
    Attributes attributes;
    std::vector<Attributes> targets;
    int indices = -1, material = -1;
    std::uint64_t mode = triangle_list;
};

struct MeshSource {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<double> weights;
};

struct Node {
    std::string name;
    int mesh = -1, skin = -1, camera = -1, light = -1;
    bool is_instanced = false;
    Attributes instances;  ///< EXT_mesh_gpu_instancing: TRANSLATION, ROTATION, SCALE of every instance
    std::vector<int> children;
    std::optional<glm::dmat4> matrix;  ///< instead of the three
    glm::dvec3 translation{0}, scale{1};
    glm::dquat rotation{1, 0, 0, 0};
    std::vector<double> weights;
};

struct Skin {
    std::string name;
    std::vector<int> joints;
    int inverse_bind_matrices = -1;
};

struct AnimationSampler {
    int input = -1, output = -1;
    std::string interpolation;
};

struct AnimationChannel {
    int sampler = -1, node = -1;
    std::string path;
};

struct Animation {
    std::string name;
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
};

struct CameraSource {
    std::string name, type;
    double yfov = 0, znear = 0;
};

struct LightSource {
    std::string name, type;
    glm::dvec3 color{1};
    double intensity = 1, range = 0, inner_angle = 0, outer_angle = 0;
};

struct Image {
    std::string name, uri;
    Bytes content;
};

struct TextureSource {
    int image = -1, sampler = -1;
};

/// glTF's own numbers.
enum Filter : std::uint64_t {
    nearest_filter = 9728,
    linear_filter = 9729,
    nearest_mipmap_nearest = 9984,
    linear_mipmap_nearest = 9985,
    nearest_mipmap_linear = 9986,
    linear_mipmap_linear = 9987
};
enum Wrap : std::uint64_t { repeat = 10497, clamp_to_edge = 33071, mirrored_repeat = 33648 };

struct Sampler {
    std::uint64_t mag_filter = linear_filter, min_filter = linear_mipmap_linear, wrap_s = repeat, wrap_t = repeat;
};

struct Document {
    std::vector<std::string> extensions_used, extensions_required;
    std::vector<BufferView> views;
    std::vector<Accessor> accessors;
    std::vector<MeshSource> meshes;
    std::vector<MaterialSource> materials;
    std::vector<Node> nodes;
    std::optional<std::vector<std::vector<int>>> scenes;  ///< the roots of each
    int scene = 0;
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<CameraSource> cameras;
    std::vector<LightSource> lights;
    std::vector<Image> images;
    std::vector<TextureSource> textures;
    std::vector<Sampler> samplers;
    std::vector<std::vector<std::byte>> storage;  ///< what the views and images point into
};

}  // namespace strata::gltf
