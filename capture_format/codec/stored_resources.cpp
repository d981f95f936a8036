// Names the bulk of resources and gives it to the blobs.
#include "capture_format/codec/stored_resources.h"

#include "capture_format/codec/texture_bytes.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/texture.h"

namespace strata {

StoredTexture store(const Texture& texture, BlobCollector& blobs) {
    return {.texture = {.name = texture.name,
                        .format = texture.format,
                        .width = texture.width,
                        .height = texture.height,
                        .mips = texture.mips,
                        .address = texture.address,
                        .magnify = texture.magnify,
                        .minify = texture.minify,
                        .between_mips = texture.between_mips,
                        .texels = {}},
            .texels = blobs.put(texture.texels, texel_bytes(texture.format))};
}

StoredMesh store(const Mesh& mesh, BlobCollector& blobs) {
    return {.name = mesh.name,
            .positions = store(mesh.positions, blobs),
            .normals = store(mesh.normals, blobs),
            .tangents = store(mesh.tangents, blobs),
            .uv0 = store(mesh.uv0, blobs),
            .uv1 = store(mesh.uv1, blobs),
            .colors = store(mesh.colors, blobs),
            .indices = store(mesh.indices, blobs)};
}

StoredResources store_resources(const Frame& frame, BlobCollector& blobs) {
    StoredResources stored{.textures = {}, .meshes = {}, .materials = frame.materials};
    for (const Texture& texture : frame.textures) stored.textures.push_back(store(texture, blobs));
    for (const Mesh& mesh : frame.meshes) stored.meshes.push_back(store(mesh, blobs));
    return stored;
}

}  // namespace strata
