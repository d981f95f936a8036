#include "capture_format/import/gltf_load.h"

#include <algorithm>
#include <numbers>

#include "capture_format/import/gltf_check.h"
#include "capture_format/import/gltf_json.h"
#include "capture_format/import/gltf_meshopt.h"

namespace strata::gltf {
namespace {

glm::dvec3 vector3(const std::vector<double>& values, glm::dvec3 fallback) {
    return values.empty() ? fallback : glm::dvec3(values[0], values[1], values[2]);
}

Attributes attributes(Fields fields) {
    const auto references = fields.references();
    return {references.begin(), references.end()};
}

Primitive read_primitive(Fields fields) {
    Primitive primitive;
    primitive.attributes = attributes(fields.object("attributes"));
    primitive.indices = fields.index("indices");
    primitive.material = fields.index("material");
    primitive.mode = fields.size("mode", triangle_list);
    fields.each("targets", [&](Fields target) { primitive.targets.push_back(attributes(target)); });
    return primitive;
}

Accessor read_accessor(Fields fields) {
    Accessor accessor;
    accessor.view = fields.index("bufferView");
    accessor.offset = fields.size("byteOffset", 0);
    accessor.count = fields.size("count", 0);
    accessor.component_type = fields.size("componentType", 0);
    accessor.type = fields.text("type");
    accessor.normalized = fields.flag("normalized", false);
    if (!fields.has("sparse")) return accessor;
    Fields sparse = fields.object("sparse"), indices = sparse.object("indices"), values = sparse.object("values");
    accessor.sparse = Sparse{.count = sparse.size("count", 0),
                             .indices_offset = indices.size("byteOffset", 0),
                             .indices_type = indices.size("componentType", 0),
                             .values_offset = values.size("byteOffset", 0),
                             .indices_view = indices.index("bufferView"),
                             .values_view = values.index("bufferView")};
    return accessor;
}

Node read_node(Fields fields) {
    Node node;
    node.name = fields.text("name");
    node.mesh = fields.index("mesh");
    node.skin = fields.index("skin");
    node.camera = fields.index("camera");
    node.light = fields.object("extensions").object("KHR_lights_punctual").index("light");
    Fields instancing = fields.object("extensions").object("EXT_mesh_gpu_instancing");
    node.is_instanced = fields.object("extensions").has("EXT_mesh_gpu_instancing");
    node.instances = attributes(instancing.object("attributes"));
    node.children = fields.indices("children");
    if (const auto values = fields.numbers("matrix", 16); !values.empty()) {
        node.matrix.emplace();
        for (int i = 0; i < 16; ++i) (*node.matrix)[i / 4][i % 4] = values[static_cast<std::size_t>(i)];  // both column-major
    }
    node.translation = vector3(fields.numbers("translation", 3), node.translation);
    node.scale = vector3(fields.numbers("scale", 3), node.scale);
    if (const auto values = fields.numbers("rotation", 4); !values.empty()) {
        node.rotation = {values[3], values[0], values[1], values[2]};
    }
    node.weights = fields.numbers("weights", 0);
    return node;
}

Animation read_animation(Fields fields) {
    Animation animation{.name = fields.text("name"), .samplers = {}, .channels = {}};
    fields.each("samplers", [&](Fields sampler) {
        animation.samplers.push_back({sampler.index("input"), sampler.index("output"), sampler.text("interpolation", "LINEAR")});
    });
    fields.each("channels", [&](Fields channel) {
        Fields target = channel.object("target");
        animation.channels.push_back({channel.index("sampler"), target.index("node"), target.text("path")});
    });
    return animation;
}

LightSource read_light(Fields fields) {
    Fields spot = fields.object("spot");
    return {.name = fields.text("name"),
            .type = fields.text("type"),
            .color = vector3(fields.numbers("color", 3), glm::dvec3(1)),
            .intensity = fields.number("intensity", 1),
            .range = fields.number("range", 0),
            .inner_angle = spot.number("innerConeAngle", 0),
            .outer_angle = spot.number("outerConeAngle", std::numbers::pi / 4)};
}

/// Reads the lists of one file.
class Loader {
public:
    Loader(const Folder& folder, MemoryBudget& budget) : folder_(folder), budget_(budget) {}

    Result<Document> run(std::vector<std::byte> file) {
        document_.storage.push_back(std::move(file));
        const auto chunks = split_chunks(document_.storage.back());
        if (!chunks) return chunks.error();
        const auto json = parse_json(chunks->json, budget_);
        if (!json) return json.error();
        std::optional<Error> problem;
        Fields root(*json, "glTF", problem);
        const std::string version = root.object("asset").text("version");
        if (const auto good = check_version(version, root.object("asset").text("minVersion")); !good) return good.error();
        read_bytes(root, chunks->binary);
        read_scene(root);
        read_surfaces(root);
        if (problem) return *problem;
        if (lacking_) return *lacking_;
        if (const auto good = check_references(document_); !good) return good.error();
        return std::move(document_);
    }

private:
    /// No bytes. Broken ones are a fault of those who need them; too few bytes of memory end the import.
    Bytes none(Error error) {
        if (error.fault == Fault::device_lacks && !lacking_) lacking_ = error;
        return {{}, std::move(error)};
    }

    /// What a URI stands for, kept in the document.
    Bytes resource(const std::string& uri) {
        auto bytes = folder_.read(uri, budget_);
        if (!bytes) return none(bytes.error());
        document_.storage.push_back(*std::move(bytes));
        return {document_.storage.back(), {}};
    }

    Bytes read_buffer(Fields& fields, std::size_t index, std::span<const std::byte> binary) {
        const std::uint64_t length = fields.size("byteLength", 0);
        const std::string uri = fields.text("uri");
        const bool fallback = fields.object("extensions").object("EXT_meshopt_compression").flag("fallback", false);
        if (uri.empty() && (fallback || index != 0 || binary.empty())) {
            return none(fail(Fault::bad_input, "import.gltf.buffer_without_bytes",
                             "buffer {buffer} has no uri, and no binary chunk is left for it", index));
        }
        Bytes buffer = uri.empty() ? Bytes{binary, {}} : resource(uri);
        if (buffer.fault) return none(within(*buffer.fault, "buffer {buffer}", index));
        if (length > buffer.bytes.size()) {
            return none(fail(Fault::bad_input, "import.gltf.buffer_cut",
                             "buffer {buffer} claims {claimed_bytes} bytes; {bytes} are there", index, length,
                             buffer.bytes.size()));
        }
        return {buffer.bytes.first(length), {}};
    }

    Bytes part(const Fields& where, int buffer, std::uint64_t offset, std::uint64_t length) {
        if (buffer < 0 || static_cast<std::size_t>(buffer) >= buffers_.size()) {
            return none(within(no_such("buffer", buffer, buffers_.size()), "{place}", where.where()));
        }
        const Bytes& source = buffers_[static_cast<std::size_t>(buffer)];
        if (source.fault) return source;
        if (offset > source.bytes.size() || length > source.bytes.size() - offset) {
            return none(fail(Fault::bad_input, "import.gltf.buffer_view_range",
                             "{place} extends past the end of its buffer of {bytes} bytes", where.where(), source.bytes.size()));
        }
        return {source.bytes.subspan(offset, length), {}};
    }

    Bytes part(Fields& fields) {
        return part(fields, fields.index("buffer"), fields.size("byteOffset", 0), fields.size("byteLength", 0));
    }

    BufferView read_view(Fields fields) {
        const std::size_t stride = fields.size("byteStride", 0);
        if (!fields.object("extensions").has("EXT_meshopt_compression")) return {part(fields), stride};
        Fields packed = fields.object("extensions").object("EXT_meshopt_compression");
        const Bytes source = part(packed);
        if (source.fault) {
            Bytes fallback = part(fields);
            return {fallback.fault ? source : fallback, stride};
        }
        auto unpacked = decode_meshopt(source.bytes,
                                       {.count = packed.size("count", 0),
                                        .stride = packed.size("byteStride", 0),
                                        .mode = packed.text("mode"),
                                        .filter = packed.text("filter", "NONE")},
                                       budget_);
        if (!unpacked) return {none(within(unpacked.error(), "{place}", fields.where())), stride};
        document_.storage.push_back(*std::move(unpacked));
        return {{document_.storage.back(), {}}, stride};
    }

    void read_bytes(Fields& root, std::span<const std::byte> binary) {
        root.each("buffers", [&](Fields fields) { buffers_.push_back(read_buffer(fields, buffers_.size(), binary)); });
        root.each("bufferViews", [&](Fields fields) { document_.views.push_back(read_view(fields)); });
        root.each("accessors", [&](Fields fields) { document_.accessors.push_back(read_accessor(fields)); });
        root.each("images", [&](Fields fields) { document_.images.push_back(read_image(fields)); });
    }

    Image read_image(Fields fields) {
        Image image{.name = fields.text("name"), .uri = fields.text("uri"), .content = {}};
        const int view = fields.index("bufferView");
        if (view >= 0) {
            const bool exists = static_cast<std::size_t>(view) < document_.views.size();
            image.content = exists ? document_.views[static_cast<std::size_t>(view)].content
                                   : none(no_such("buffer view", view, document_.views.size()));
        } else {
            image.content = image.uri.empty() ? none(fail(Fault::bad_input, "import.gltf.image_without_bytes",
                                                          "the image has neither a uri nor a buffer view"))
                                              : resource(image.uri);
        }
        if (image.uri.starts_with("data:")) image.uri = "data URI";
        return image;
    }

    void read_scene(Fields& root) {
        document_.extensions_used = root.texts("extensionsUsed");
        document_.extensions_required = root.texts("extensionsRequired");
        root.each("meshes", [&](Fields fields) {
            MeshSource mesh{.name = fields.text("name"), .primitives = {}, .weights = fields.numbers("weights", 0)};
            fields.each("primitives", [&](Fields primitive) { mesh.primitives.push_back(read_primitive(primitive)); });
            document_.meshes.push_back(std::move(mesh));
        });
        root.each("nodes", [&](Fields fields) { document_.nodes.push_back(read_node(fields)); });
        if (root.has("scenes")) document_.scenes.emplace();
        root.each("scenes", [&](Fields fields) { document_.scenes->push_back(fields.indices("nodes")); });
        document_.scene = std::max(root.index("scene"), 0);
        root.each("skins", [&](Fields fields) {
            document_.skins.push_back({fields.text("name"), fields.indices("joints"), fields.index("inverseBindMatrices")});
        });
        root.each("animations", [&](Fields fields) { document_.animations.push_back(read_animation(fields)); });
        root.each("cameras", [&](Fields fields) {
            Fields perspective = fields.object("perspective");
            document_.cameras.push_back(
                {fields.text("name"), fields.text("type"), perspective.number("yfov", 0), perspective.number("znear", 0)});
        });
        root.object("extensions").object("KHR_lights_punctual").each("lights", [&](Fields fields) {
            document_.lights.push_back(read_light(fields));
        });
    }

    void read_surfaces(Fields& root) {
        root.each("materials", [&](Fields fields) { document_.materials.push_back(read_material(fields)); });
        root.each("textures", [&](Fields fields) {
            document_.textures.push_back({fields.index("source"), fields.index("sampler")});
        });
        root.each("samplers", [&](Fields fields) {
            document_.samplers.push_back({fields.size("magFilter", linear_filter), fields.size("minFilter", linear_mipmap_linear),
                                          fields.size("wrapS", Wrap::repeat), fields.size("wrapT", Wrap::repeat)});
        });
    }

    const Folder& folder_;
    MemoryBudget& budget_;
    Document document_;
    std::vector<Bytes> buffers_;
    std::optional<Error> lacking_;
};

}  // namespace

Result<Document> load_document(std::vector<std::byte> file, const Folder& folder, MemoryBudget& budget) {
    return Loader(folder, budget).run(std::move(file));
}

}  // namespace strata::gltf
