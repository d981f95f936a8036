// Small glTF files for tests: one buffer as a data URI, one buffer view per accessor, and the rest as JSON.
#pragma once

#include <cstring>
#include <initializer_list>
#include <optional>
#include <string>

#include "capture_format/import/gltf.h"

namespace strata {

/// 2 x 2: red, half-covered green; uncovered blue, white.
inline constexpr const char* tiny_png =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAFElEQVR42mP4z8DwHwgbGMA0EAAAP9cIeV/HbbEAAAAASUVORK5CYII=";
/// 8 x 8 of gray 188.
inline constexpr const char* tiny_jpeg =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wCEAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMUFRUVDA8XGBYUGBIUFRQB"
    "AwQEBQQFCQUFCRQNCw0UFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFP/AABEIAAgACAMBIgACEQEDEQH/xAGi"
    "AAABBQEBAQEBAQAAAAAAAAAAAQIDBAUGBwgJCgsQAAIBAwMCBAMFBQQEAAABfQECAwAEEQUSITFBBhNRYQcicRQygZGhCCNCscEVUtHwJDNicoIJChYXGBka"
    "JSYnKCkqNDU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hpanN0dXZ3eHl6g4SFhoeIiYqSk5SVlpeYmZqio6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS"
    "09TV1tfY2drh4uPk5ebn6Onq8fLz9PX29/j5+gEAAwEBAQEBAQEBAQAAAAAAAAECAwQFBgcICQoLEQACAQIEBAMEBwUEBAABAncAAQIDEQQFITEGEkFRB2Fx"
    "EyIygQgUQpGhscEJIzNS8BVictEKFiQ04SXxFxgZGiYnKCkqNTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqCg4SFhoeIiYqSk5SVlpeY"
    "mZqio6Slpqeoqaqys7S1tre4ubrCw8TFxsfIycrS09TV1tfY2dri4+Tl5ufo6ery8/T19vf4+fr/2gAMAwEAAhEDEQA/APqCiiigD//Z";

std::string base64(const std::string& bytes);

template <typename T>
std::string bytes_of(std::initializer_list<T> values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), std::data(values), bytes.size());
    return bytes;
}

/// A glTF with one buffer; every accessor gets a buffer view of its own.
class Gltf {
public:
    /// The index of the new accessor. `more` is JSON that follows a comma.
    int accessor(const std::string& bytes, int component, const std::string& type, std::size_t count,
                 const std::string& more = "") {
        views_ += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}", views_.empty() ? "" : ",", bytes_.size(),
                              bytes.size());
        accessors_ += fmt::format("{}{{\"bufferView\":{},\"componentType\":{},\"type\":\"{}\",\"count\":{}{}}}",
                                  accessors_.empty() ? "" : ",", count_, component, type, count, more);
        bytes_ += bytes;
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return count_++;
    }
    int floats(std::initializer_list<float> values, const std::string& type, std::size_t components,
               const std::string& more = "") {
        return accessor(bytes_of(values), 5126, type, values.size() / components, more);
    }
    /// A triangle (0,0,0) (1,0,0) (0,1,0) as accessor 0.
    Gltf& with_triangle() {
        floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
        return *this;
    }
    std::string text(const std::string& members) const {
        return fmt::format(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"buffers\":[{{\"byteLength\":{},\"uri\":"
            "\"data:application/octet-stream;base64,{}\"}}],\"bufferViews\":[{}],\"accessors\":[{}],{}}}",
            bytes_.size(), base64(bytes_), views_, accessors_, members);
    }

private:
    std::string bytes_, views_, accessors_;
    int count_ = 0;
};

/// One node that shows one mesh of one primitive.
std::string showing(const std::string& primitive, const std::string& more = "");
/// A triangle with one image, on a material that blends; both arguments are JSON members.
std::string with_image(const std::string& image, const std::string& texture_info);
/// A primitive of Gltf::with_triangle.
inline constexpr const char* triangle = R"({"attributes":{"POSITION":0}})";

/// The scene of a text in memory, without any file; throws the sentence of an error.
GltfScene opened(const std::string& text, const GltfOptions& options = {});
/// Its first frame.
Result<ImportedScene> import_text(const std::string& text, const GltfOptions& options = {});
/// What was imported; throws the sentence of an error.
ImportedScene imported(const std::string& text, const GltfOptions& options = {});
/// The error; nothing when it was imported.
std::optional<Error> refusal(const std::string& text);

}  // namespace strata
