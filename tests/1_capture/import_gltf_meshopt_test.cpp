// EXT_meshopt_compression: what meshoptimizer's own encoder wrote is read, in every mode and with every filter.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/import/gltf_meshopt.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using testing::ElementsAre;

/// Four vertices of a square; as bytes they are what an uncompressed glTF would hold.
constexpr float square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

std::string encoded_vertices(const void* vertices, std::size_t count, std::size_t stride) {
    std::string bytes(meshopt_encodeVertexBufferBound(count, stride), '\0');
    auto* target = reinterpret_cast<unsigned char*>(bytes.data());
    bytes.resize(meshopt_encodeVertexBuffer(target, bytes.size(), vertices, count, stride));
    return bytes;
}

using IndexEncoder = std::size_t (*)(unsigned char*, std::size_t, const unsigned int*, std::size_t);

std::string encoded_indices(const std::vector<unsigned int>& indices, IndexEncoder encode) {
    std::string bytes(1000, '\0');
    bytes.resize(encode(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), indices.data(), indices.size()));
    return bytes;
}

template <typename T>
std::vector<T> decoded(const std::string& packed, const gltf::MeshoptLayout& layout) {
    MemoryBudget budget(1 << 20);
    const auto bytes = gltf::decode_meshopt(std::as_bytes(std::span(packed)), layout, budget);
    if (!bytes) throw std::runtime_error(bytes.error().sentence);
    std::vector<T> values(bytes->size() / sizeof(T));
    std::memcpy(values.data(), bytes->data(), bytes->size());
    return values;
}

TEST(GltfMeshopt, TrianglesAndSequencesOfBothWidthsComeBack) {
    const std::vector<unsigned int> indices = {0, 1, 2, 2, 1, 3, 4, 5, 6};
    const std::string triangles = encoded_indices(indices, meshopt_encodeIndexBuffer);
    const std::string sequence = encoded_indices(indices, meshopt_encodeIndexSequence);
    EXPECT_THAT(decoded<std::uint32_t>(triangles, {9, 4, "TRIANGLES", "NONE"}), testing::ElementsAreArray(indices));
    EXPECT_THAT(decoded<std::uint16_t>(triangles, {9, 2, "TRIANGLES", "NONE"}), testing::ElementsAreArray(indices));
    EXPECT_THAT(decoded<std::uint32_t>(sequence, {9, 4, "INDICES", "NONE"}), testing::ElementsAreArray(indices));
    EXPECT_THAT(decoded<std::uint16_t>(sequence, {9, 2, "INDICES", "NONE"}), testing::ElementsAreArray(indices));
}

TEST(GltfMeshopt, EveryFilterGivesBackWhatItsEncoderTook) {
    const float normals[] = {0, 0, 1, 0, 0.6f, 0, 0.8f, 0};
    std::int8_t octahedral[8];
    meshopt_encodeFilterOct(octahedral, 2, 4, 8, normals);
    const auto normal = decoded<std::int8_t>(encoded_vertices(octahedral, 2, 4), {2, 4, "ATTRIBUTES", "OCTAHEDRAL"});
    EXPECT_EQ(normal[2], 127);
    EXPECT_NEAR(normal[4] / 127.0, 0.6, 0.01);
    EXPECT_NEAR(normal[6] / 127.0, 0.8, 0.01);

    const float turn[] = {0, 0, 0.70710678f, 0.70710678f};
    std::int16_t quaternion[4];
    meshopt_encodeFilterQuat(quaternion, 1, 8, 16, turn);
    const auto rotation = decoded<std::int16_t>(encoded_vertices(quaternion, 1, 8), {1, 8, "ATTRIBUTES", "QUATERNION"});
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(rotation[i] / 32767.0, turn[i], 1e-4) << i;

    std::uint32_t exponential[12];
    meshopt_encodeFilterExp(exponential, 4, 12, 24, square);
    EXPECT_THAT(decoded<float>(encoded_vertices(exponential, 4, 12), {4, 12, "ATTRIBUTES", "EXPONENTIAL"}),
                testing::ElementsAreArray(square));
}

/// A glTF whose positions and indices are compressed; `fallback` are the members of the buffer they would be in otherwise.
std::string compressed(const std::string& fallback, const std::string& vertices) {
    const std::string indices = encoded_indices({0, 1, 2, 0, 2, 3}, meshopt_encodeIndexBuffer);
    const auto buffer = [](const std::string& bytes) {
        return fmt::format(R"({{"byteLength":{},"uri":"data:application/octet-stream;base64,{}"}})", bytes.size(), base64(bytes));
    };
    return fmt::format(R"({{"asset":{{"version":"2.0"}},"extensionsUsed":["EXT_meshopt_compression"],
        "extensionsRequired":["EXT_meshopt_compression"],"buffers":[{},{},{}],
        "bufferViews":[{{"buffer":2,"byteLength":48,"byteStride":12,"extensions":{{"EXT_meshopt_compression":
            {{"buffer":0,"byteLength":{},"byteStride":12,"count":4,"mode":"ATTRIBUTES"}}}}}},
          {{"buffer":2,"byteLength":12,"extensions":{{"EXT_meshopt_compression":
            {{"buffer":1,"byteLength":{},"byteStride":2,"count":6,"mode":"TRIANGLES"}}}}}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":4}},
          {{"bufferView":1,"componentType":5123,"type":"SCALAR","count":6}}],
        {}}})",
                       buffer(vertices), buffer(indices), fallback, vertices.size(), indices.size(),
                       showing(R"({"indices":1,"attributes":{"POSITION":0}})"));
}

constexpr const char* no_fallback = R"({"byteLength":60,"extensions":{"EXT_meshopt_compression":{"fallback":true}}})";

TEST(GltfMeshopt, ASceneIsReadWithoutItsFallbackBuffer) {
    const Frame frame = imported(compressed(no_fallback, encoded_vertices(square, 4, 12))).frame;
    EXPECT_THAT(frame.meshes[0].positions, ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0),
                                                       glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)));
}

TEST(GltfMeshopt, DamagedBytesAreRefused) {
    std::string damaged = encoded_vertices(square, 4, 12);
    damaged.resize(damaged.size() / 2);
    EXPECT_THAT(refusal(compressed(no_fallback, damaged)), FailsWith("import.gltf.meshopt_damaged"));
    damaged[0] = 'x';
    EXPECT_THAT(refusal(compressed(no_fallback, damaged)), FailsWith("import.gltf.meshopt_damaged"));
}

TEST(GltfMeshopt, LayoutsThatTheDecodersWouldTripOverAreRefused) {
    const auto decoded = [](const gltf::MeshoptLayout& layout) {
        MemoryBudget budget(1 << 20);
        return gltf::decode_meshopt({}, layout, budget);
    };
    EXPECT_THAT(decoded({1, 6, "ATTRIBUTES", "NONE"}), FailsWith("import.gltf.meshopt_stride", Field("stride", 6)));
    EXPECT_THAT(decoded({1, 260, "ATTRIBUTES", "NONE"}), FailsWith("import.gltf.meshopt_stride", Field("stride", 260)));
    EXPECT_THAT(decoded({3, 1, "TRIANGLES", "NONE"}), FailsWith("import.gltf.meshopt_stride", Field("stride", 1)));
    EXPECT_THAT(decoded({4, 2, "TRIANGLES", "NONE"}), FailsWith("import.gltf.meshopt_triangles", Field("indices", 4)));
    EXPECT_THAT(decoded({4, 12, "ATTRIBUTES", "OCTAHEDRAL"}),
                FailsWith("import.gltf.meshopt_filter", Field("filter", "OCTAHEDRAL")));
    EXPECT_THAT(decoded({4, 4, "ATTRIBUTES", "QUATERNION"}),
                FailsWith("import.gltf.meshopt_filter", Field("filter", "QUATERNION")));
    EXPECT_THAT(decoded({4, 4, "ATTRIBUTES", "BLUR"}), FailsWith("import.gltf.meshopt_filter", Field("filter", "BLUR")));
    EXPECT_THAT(decoded({4, 4, "ZIP", "NONE"}), FailsWith("import.gltf.meshopt_mode", Field("mode", "ZIP")));
    EXPECT_THAT(decoded({std::uint64_t{1} << 60, 256, "ATTRIBUTES", "NONE"}),
                FailsWith("memory.budget", Field("budget", "1.0 MiB")));
}

}  // namespace
}  // namespace strata
