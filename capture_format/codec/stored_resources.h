// Textures, meshes and materials as frame sections tell them: the bulk is in blobs, what remains is small. A recorder keeps
// these and not the application's bytes.
#pragma once

#include <string>
#include <vector>

#include "capture_format/container/blob_store.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/texture.h"

namespace strata {

struct Frame;  // capture_format/frame.h
struct Mesh;   // capture_format/frame/mesh.h

struct StoredTexture {
    Texture texture;  ///< without texels
    BlobName texels;
};

struct StoredMesh {
    std::string name;
    BlobName positions, normals, tangents, uv0, uv1, colors, indices;
};

struct StoredResources {
    std::vector<StoredTexture> textures;
    std::vector<StoredMesh> meshes;
    std::vector<Material> materials;
};

template <typename T>
BlobName store(const std::vector<T>& values, BlobCollector& blobs) {
    return blobs.put(std::as_bytes(std::span(values)), sizeof(T));
}
StoredTexture store(const Texture&, BlobCollector&);
StoredMesh store(const Mesh&, BlobCollector&);
/// All resources of a whole frame.
StoredResources store_resources(const Frame&, BlobCollector&);

}  // namespace strata
