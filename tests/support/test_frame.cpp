#include "tests/support/test_frame.h"

#include "passes/frame_images.h"
#include "tests/support/session.h"

namespace strata {

TestFrame::TestFrame() {
    for (const std::string& name : ShaderLibrary::built_in().names())
        if (name.starts_with("shaders/")) library.add(*ShaderLibrary::built_in().find(name));
}

Plan TestFrame::plan() const { return must(compile(graph, library)); }

Execution TestFrame::run(const RunOptions& options) { return shared_executor().run(plan(), options); }

HostImage TestFrame::result(Image image) {
    graph.keep(image);
    return run().images.at(image.id);
}

}  // namespace strata
