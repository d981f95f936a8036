// Small files at the format's corners. Sound ones have the triangles, the area and the box that a second reader finds in them;
// the others are refused with a sentence that names what is wrong.
#include <cmath>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "tests/1_capture/plain_gltf.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

struct Corner {
    std::string name, text;
    testing::Matcher<const Result<ImportedScene>&> refused = testing::_;  ///< how, for broken ones
};
void PrintTo(const Corner& corner, std::ostream* out) { *out << corner.name; }
std::string corner_name(const testing::TestParamInfo<Corner>& info) { return info.param.name; }

/// Accessors that the files below share. 0: a triangle; 1: five points in space; 2, 3, 4: indices of 8, 16, 32 bits.
Gltf shapes() {
    Gltf gltf = Gltf().with_triangle();
    gltf.floats({0, 0, 0, 2, 0, 1, 0, 3, 0, 2, 3, -1, 5, 4, 2}, "VEC3", 3);
    gltf.accessor(bytes_of<std::uint8_t>({0, 1, 2, 2, 1, 3}), 5121, "SCALAR", 6);
    gltf.accessor(bytes_of<std::uint16_t>({4, 1, 2, 3, 0}), 5123, "SCALAR", 5);
    gltf.accessor(bytes_of<std::uint32_t>({3, 4, 0, 0, 0, 1}), 5125, "SCALAR", 6);
    return gltf;
}

std::string primitives(const std::string& list) { return shapes().text(showing(list)); }

/// One mesh of the five points as a strip, shown by nodes.
std::string nodes(const std::string& list, const std::string& more = "") {
    return shapes().text(
        fmt::format(R"("nodes":[{}],"meshes":[{{"primitives":[{{"mode":5,"attributes":{{"POSITION":1}}}}]}}]{})", list, more));
}

/// The text with its first `old` replaced.
std::string changed(std::string text, const std::string& old, const std::string& fresh) {
    return text.replace(text.find(old), old.size(), fresh);
}

std::vector<Corner> sound_primitives() {
    return {
        {"ListWithoutIndices", primitives(triangle)},
        {"ListWithALooseEnd", primitives(R"({"attributes":{"POSITION":1}})")},
        {"IndicesOf8Bits", primitives(R"({"indices":2,"attributes":{"POSITION":1}})")},
        {"IndicesOf16Bits", primitives(R"({"indices":3,"attributes":{"POSITION":1}})")},
        {"IndicesOf32BitsAndATriangleWithoutArea", primitives(R"({"indices":4,"attributes":{"POSITION":1}})")},
        {"Strip", primitives(R"({"mode":5,"attributes":{"POSITION":1}})")},
        {"Fan", primitives(R"({"mode":6,"attributes":{"POSITION":1}})")},
        {"StripWithIndices", primitives(R"({"mode":5,"indices":3,"attributes":{"POSITION":1}})")},
        {"FanWithIndices", primitives(R"({"mode":6,"indices":3,"attributes":{"POSITION":1}})")},
        {"PointsBesideATriangle", primitives(R"({"mode":0,"attributes":{"POSITION":1}},{"attributes":{"POSITION":0}})")},
        {"LinesBesideATriangle", primitives(R"({"mode":1,"attributes":{"POSITION":1}},{"mode":2,"attributes":{"POSITION":1}},
                       {"mode":3,"attributes":{"POSITION":1}},{"attributes":{"POSITION":0}})")},
        {"TwoPrimitives", primitives(R"({"attributes":{"POSITION":0}},{"mode":5,"attributes":{"POSITION":1}})")},
    };
}

std::vector<Corner> sound_nodes() {
    const std::string turn = R"("rotation":[0.18257419,0.36514837,0.54772256,0.73029674])";
    return {
        {"Translation", nodes(R"({"mesh":0,"translation":[7,-3,2]})")},
        {"Rotation", nodes("{\"mesh\":0," + turn + "}")},
        {"RotationAndScale", nodes("{\"mesh\":0,\"scale\":[2,0.5,3]," + turn + "}")},
        {"Mirror", nodes(R"({"mesh":0,"scale":[-1,1,2]})")},
        {"Shear", nodes(R"({"mesh":0,"matrix":[1,0,0,0, 0.5,1,0,0, 0,0.25,2,0, 4,5,6,1]})")},
        {"ThreeLevels",
         nodes(R"({"children":[1],"translation":[1,2,3]},{"children":[2],"scale":[2,2,2]},{"mesh":0,)" + turn + "}")},
        {"OneMeshThreeTimes", nodes(R"({"mesh":0},{"mesh":0,"translation":[9,0,0]},{"mesh":0,"scale":[3,3,3]})")},
        {"SecondOfTwoScenes",
         nodes(R"({"mesh":0},{"mesh":0,"translation":[50,0,0]})", R"(,"scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}])")},
        {"FirstSceneWithoutASceneIndex",
         nodes(R"({"mesh":0},{"mesh":0,"translation":[50,0,0]})", R"(,"scenes":[{"nodes":[0]},{"nodes":[1]}])")},
        {"NodesWithoutAMesh", nodes(R"({"name":"empty"},{"mesh":0},{"children":[0]})")},
        {"AnExtensionNobodyNeeds", nodes(R"({"mesh":0})", R"(,"extensionsUsed":["EXT_nothing"])")},
        {"LeastVersion", changed(nodes(R"({"mesh":0})"), R"("version":"2.0")", R"("version":"2.0","minVersion":"2.0")")},
    };
}

/// A triangle at accessor `position` of a file with these accessors.
std::string at_accessor(const Gltf& gltf, int position, const std::string& more = "") {
    return gltf.text(showing(fmt::format(R"({{"attributes":{{"POSITION":{}}}}})", position), more));
}

std::vector<Corner> sound_accessors() {
    std::vector<Corner> corners;
    Gltf sparse = Gltf().with_triangle();
    sparse.accessor(bytes_of<std::uint8_t>({0, 2}), 5121, "SCALAR", 2);
    sparse.floats({4, 5, 6, 7, 8, 10}, "VEC3", 3);
    const std::string replaces =
        R"(,"sparse":{"count":2,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":2}})";
    sparse.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3, replaces);
    corners.push_back({"SparseOverABase", at_accessor(sparse, 3)});
    std::string without_base = at_accessor(sparse, 3);
    without_base.erase(without_base.find(R"("bufferView":3,)"), 15);
    corners.push_back({"SparseOverZeros", without_base});
    std::string zeros = at_accessor(Gltf().with_triangle(), 0);
    zeros.erase(zeros.find(R"("bufferView":0,)"), 15);
    corners.push_back({"NoBufferViewIsZeros", zeros});

    Gltf apart;
    apart.floats({9, 9, 0, 0, 0, 7, 1, 0, 0, 7, 0, 1, 0, 7}, "VEC3", 3, R"(,"byteOffset":8)");
    std::string strided = at_accessor(apart, 0);
    strided.replace(strided.find(R"("count":4)"), 9, R"("count":3)");
    strided.insert(strided.find(R"("byteLength":56})") + 15, R"(,"byteStride":16)");
    corners.push_back({"OffsetAndStride", strided});
    std::string fraction = at_accessor(Gltf().with_triangle(), 0);
    corners.push_back({"AWholeNumberWithAFraction", fraction.replace(fraction.find(R"("count":3)"), 9, R"("count":3.0)")});

    const std::string quantized = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
    Gltf shorts;
    shorts.accessor(bytes_of<std::uint16_t>({0, 0, 0, 0, 300, 0, 0, 0, 0, 40000, 2, 0}), 5123, "VEC3", 3);
    std::string padded = at_accessor(shorts, 0, quantized);
    padded.insert(padded.find(R"("byteLength":24})") + 15, R"(,"byteStride":8)");
    corners.push_back({"QuantizedShorts", padded});
    Gltf bytes;
    bytes.accessor(bytes_of<std::int8_t>({0, 0, 0, 127, -128, 0, 10, 127, 64}), 5120, "VEC3", 3, R"(,"normalized":true)");
    corners.push_back({"QuantizedNormalizedBytes", at_accessor(bytes, 0, quantized)});
    return corners;
}

std::vector<Corner> sound_moved() {
    Gltf gltf = Gltf().with_triangle();
    gltf.floats({0, 0, 2, 0, 1, 0, 3, 0, 0}, "VEC3", 3);
    gltf.floats({5, 0, 0, 0, 5, 0, 0, 0, 5}, "VEC3", 3);
    gltf.accessor(bytes_of<std::int8_t>({0, 0, 90, 90, 127, 0, 0, 0, 0, 0, 0, 127}), 5120, "VEC4", 3, R"(,"normalized":true)");
    gltf.floats({2, 1, 1, -1, 1, 1, 1, 1, 3}, "VEC3", 3);
    const auto morphed = [&](const std::string& node, const std::string& mesh) {
        return gltf.text(fmt::format(R"("nodes":[{{"mesh":0{}}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},
            "targets":[{{"POSITION":1}},{{"POSITION":2}}]}}]{}}}])",
                                     node, mesh));
    };
    const auto instanced = [&](const std::string& attributes, const std::string& node) {
        return gltf.text(fmt::format(R"("nodes":[{{"children":[1],"scale":[1,2,3]}},
            {{"mesh":0{},"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{{}}}}}}}}}],"meshes":[{{"primitives":[{}]}}])",
                                     node, attributes, triangle));
    };
    return {
        {"MorphTargetsByTheMesh", morphed("", R"(,"weights":[0.5,-1])")},
        {"MorphTargetsByTheNode", morphed(R"(,"weights":[2,0.25])", R"(,"weights":[0.5,-1])")},
        {"MorphTargetsWithoutWeights", morphed("", "")},
        {"InstancesMoved", instanced(R"("TRANSLATION":2)", "")},
        {"InstancesTurnedByBytes", instanced(R"("ROTATION":3)", R"(,"translation":[1,1,1])")},
        {"InstancesOfEverything", instanced(R"("TRANSLATION":2,"ROTATION":3,"SCALE":4)", R"(,"scale":[2,2,2])")},
        {"InstancesNumberedByAnApplication", instanced(R"("_ID":2)", "")},
    };
}

class SoundCorner : public testing::TestWithParam<Corner> {};

TEST_P(SoundCorner, HasTheTrianglesThatASecondReaderFinds) {
    const TriangleMeasures expected = measure_plainly(GetParam().text);
    TriangleMeasures found;
    const Frame frame = imported(GetParam().text).frame;
    for (const Draw& draw : frame.draws) {
        const Mesh& mesh = frame.meshes[draw.mesh];
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            std::array<std::array<double, 3>, 3> corners;
            for (std::size_t c = 0; c < 3; ++c) {
                const glm::dvec4 p = draw.to_world * glm::dvec4(glm::dvec3(mesh.positions[mesh.indices[i + c]]), 1);
                corners[c] = {p.x, p.y, p.z};
            }
            found.add(corners);
        }
    }
    EXPECT_GT(expected.triangles, 0u);
    EXPECT_EQ(found.triangles, expected.triangles);
    EXPECT_NEAR(found.area, expected.area, 1e-5 * (1 + expected.area));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(found.low[axis], expected.low[axis], 1e-5 * (1 + std::abs(expected.low[axis]))) << axis;
        EXPECT_NEAR(found.high[axis], expected.high[axis], 1e-5 * (1 + std::abs(expected.high[axis]))) << axis;
    }
}

INSTANTIATE_TEST_SUITE_P(Primitives, SoundCorner, testing::ValuesIn(sound_primitives()), corner_name);
INSTANTIATE_TEST_SUITE_P(Nodes, SoundCorner, testing::ValuesIn(sound_nodes()), corner_name);
INSTANTIATE_TEST_SUITE_P(Accessors, SoundCorner, testing::ValuesIn(sound_accessors()), corner_name);
INSTANTIATE_TEST_SUITE_P(Moved, SoundCorner, testing::ValuesIn(sound_moved()), corner_name);

std::vector<Corner> broken_files() {
    const std::string sound = primitives(triangle);
    Gltf more = Gltf().with_triangle();
    more.floats({0, 0, 1, 0, 0, 1}, "VEC3", 3);
    more.floats({0, std::nanf(""), 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    more.accessor(bytes_of<std::uint8_t>({7}), 5121, "SCALAR", 1);
    more.floats({1, 2, 3}, "VEC3", 3);
    const auto sparse = [&](const std::string& members) {
        Gltf gltf = more;
        gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3, R"(,"sparse":{)" + members + "}");
        return at_accessor(gltf, 5);
    };
    return {
        {"AMaterialThatDoesNotExist", primitives(R"({"material":2,"attributes":{"POSITION":0}})"),
         FailsWith("import.gltf.index_range", Field("list", "material"), Field("index", 2))},
        {"AModeThatDoesNotExist", primitives(R"({"mode":7,"attributes":{"POSITION":0}})"),
         FailsWith("import.gltf.mode", Field("mode", 7))},
        {"NoVersion", changed(sound, R"("version":"2.0")", R"("generator":"x")"),
         FailsWith("import.gltf.version", Field("version", ""))},
        {"NoPositions", primitives(R"({"attributes":{"NORMAL":0}})"),
         FailsWith("import.gltf.index_range", Field("list", "accessor"), Field("index", -1), Field("attribute", "POSITION"))},
        {"PositionsOfTwoComponents", changed(sound, "VEC3", "VEC2"),
         FailsWith("import.gltf.accessor_type", Field("accessor", 0), Field("type", "VEC2"), Field("components", 3))},
        {"AnUnknownComponentType", changed(sound, "5126", "5124"),
         FailsWith("import.gltf.component_type", Field("component_type", 5124))},
        {"MoreElementsThanBytes", changed(sound, R"("count":3)", R"("count":4)"),
         FailsWith("import.gltf.accessor_range", Field("elements", 4), Field("view", 0), Field("view_bytes", 36))},
        {"AViewBeyondItsBuffer", changed(sound, R"("byteLength":36)", R"("byteLength":36000)"),
         FailsWith("import.gltf.buffer_view_range", Field("place", "glTF.bufferViews[0]"))},
        {"ABufferThatDoesNotExist", changed(sound, R"("buffer":0)", R"("buffer":3)"),
         FailsWith("import.gltf.index_range", Field("list", "buffer"), Field("index", 3))},
        {"AStrideBelowTheElement", changed(sound, R"("byteLength":36)", R"("byteLength":36,"byteStride":4)"),
         FailsWith("import.gltf.accessor_range", Field("stride", 4), Field("element_bytes", 12))},
        {"AnIndexBeyondTheVertices", primitives(R"({"indices":3,"attributes":{"POSITION":0}})"),
         FailsWith("import.gltf.vertex_range", Field("vertex", 4), Field("vertices", 3))},
        {"IndicesThatAreFloats", changed(primitives(R"({"indices":4,"attributes":{"POSITION":1}})"), "5125", "5126"),
         FailsWith("import.gltf.index_type", Field("accessor", 4))},
        {"IndicesThatDoNotExist", primitives(R"({"indices":9,"attributes":{"POSITION":0}})"),
         FailsWith("import.gltf.index_range", Field("list", "accessor"), Field("index", 9))},
        {"NormalsOfAnotherLength", more.text(showing(R"({"attributes":{"POSITION":0,"NORMAL":1}})")),
         FailsWith("import.gltf.attribute_count", Field("attribute", "NORMAL"), Field("elements", 2), Field("wanted", 3))},
        {"PositionsThatAreNotNumbers", at_accessor(more, 2), FailsWith("import.gltf.not_finite", Field("attribute", "POSITION"))},
        {"AMeshThatDoesNotExist", nodes(R"({"mesh":1})"),
         FailsWith("import.gltf.index_range", Field("list", "mesh"), Field("index", 1))},
        {"AChildThatDoesNotExist", nodes(R"({"mesh":0,"children":[5]})"),
         FailsWith("import.gltf.index_range", Field("list", "node"), Field("index", 5))},
        {"NodesInACircle", nodes(R"({"mesh":0},{"children":[2]},{"children":[1]})", R"(,"scenes":[{"nodes":[1]}])"),
         FailsWith("import.gltf.node_cycle")},
        {"ANodeOfTwoParents", nodes(R"({"mesh":0},{"children":[0]},{"children":[0]})"), FailsWith("import.gltf.node_cycle")},
        {"ASceneThatDoesNotExist", nodes(R"({"mesh":0})", R"(,"scene":3,"scenes":[{"nodes":[0]}])"),
         FailsWith("import.gltf.index_range", Field("list", "scene"), Field("index", 3))},
        {"AMatrixOfNineNumbers", nodes(R"({"mesh":0,"matrix":[1,0,0,0,1,0,0,0,1]})"),
         FailsWith("import.gltf.member_type", Field("member", "matrix"))},
        {"AnExtensionThatIsRequired", nodes(R"({"mesh":0})", R"(,"extensionsRequired":["EXT_nothing"])"),
         FailsWith("import.gltf.extension", Field("extension", "EXT_nothing"))},
        {"ASparseIndexBeyondTheElements",
         sparse(R"("count":1,"indices":{"bufferView":3,"componentType":5121},"values":{"bufferView":4})"),
         FailsWith("import.gltf.sparse_range", Field("element", 7), Field("elements", 3))},
        {"MoreSparseElementsThanElements",
         sparse(R"("count":4,"indices":{"bufferView":3,"componentType":5121},"values":{"bufferView":4})"),
         FailsWith("import.gltf.sparse_count", Field("replaced", 4), Field("elements", 3))},
        {"SparseIndicesThatAreFloats",
         sparse(R"("count":1,"indices":{"bufferView":3,"componentType":5126},"values":{"bufferView":4})"),
         FailsWith("import.gltf.sparse_index_type", Field("component_type", 5126))},
        {"ATargetOfAnotherLength", more.text(showing(R"({"attributes":{"POSITION":0},"targets":[{"POSITION":1}]})", "")),
         FailsWith("import.gltf.attribute_count", Field("attribute", "POSITION"), Field("elements", 2))},
        {"ACameraThatDoesNotExist", nodes(R"({"mesh":0,"camera":0})"),
         FailsWith("import.gltf.index_range", Field("list", "camera"), Field("index", 0))},
        {"ATextureThatDoesNotExist", nodes(R"({"mesh":0})", R"(,"materials":[{"normalTexture":{"index":1}}])"),
         FailsWith("import.gltf.index_range", Field("list", "texture"), Field("index", 1))},
        {"ASamplerThatDoesNotExist", nodes(R"({"mesh":0})", R"(,"textures":[{"sampler":0}])"),
         FailsWith("import.gltf.index_range", Field("list", "sampler"), Field("index", 0))},
    };
}

class BrokenCorner : public testing::TestWithParam<Corner> {};

TEST_P(BrokenCorner, IsRefusedByName) {
    const auto scene = import_text(GetParam().text);
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().fault, Fault::bad_input);
    EXPECT_THAT(scene, GetParam().refused);
}

INSTANTIATE_TEST_SUITE_P(Files, BrokenCorner, testing::ValuesIn(broken_files()), corner_name);

}  // namespace
}  // namespace strata
