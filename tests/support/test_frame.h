// A graph with shaders written in the test, compiled and run on the shared executor.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "passes/graph/graph.h"
#include "passes/graph/plan.h"
#include "tests/support/device.h"
#include "tests/support/glsl.h"

namespace strata {

struct TestFrame {
    TestFrame();

    Graph graph;
    ShaderLibrary library;  ///< starts with those of passes/shaders

    /// Adds a shader by the name that graph.compute(), draw() and fullscreen() look for.
    void shader(const std::string& name, std::string_view source) { library.add(glsl(name, source)); }
    Plan plan() const;
    Execution run(const RunOptions& = {});
    /// Keeps the image, runs, and returns it.
    HostImage result(Image);
};

/// A buffer of values under the key, replaced on every call.
template <typename T>
Buffer import_values(Graph& graph, std::string name, ImportId id, const std::vector<T>& values) {
    shared_executor().upload(id, std::as_bytes(std::span(values)));
    return graph.import(std::move(name), values.size() * sizeof(T), id);
}

/// The bytes of a buffer as values.
template <typename T>
std::vector<T> values_of(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

}  // namespace strata
