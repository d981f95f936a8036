// strata export --image: what a stage gave, or a debug view.
#include "replay/cli/export_kinds.h"
#include "replay/cli/left_out.h"
#include "replay/cli/output_picture.h"
#include "replay/cli/run_json.h"

namespace strata {
namespace {

Result<void> write_picture(const ExportOptions& options, const Run& run) {
    if (run.images.size() != 1)
        return fail_unnamed(Fault::usage, "a .png holds one image, not {}; an .exr holds them all", run.images.size());
    const std::string& image = run.images.begin()->first;
    if (!options.caption) return write_plain_picture(options.output, run, image);
    return write_output_picture(options.output, run, image,
                                fmt::format("{} frame {}", options.open.capture.filename().string(), options.frame));
}

}  // namespace

Result<void> export_images(const ExportOptions& options) {
    const std::string kind = options.output.extension().string();
    if (kind != ".exr" && kind != ".png")
        return fail_unnamed(Fault::usage, "images are written as .exr or .png, not as '{}'", options.output.filename().string());
    if (options.caption && kind == ".exr")
        return fail_unnamed(Fault::usage, "--caption is for a .png; an .exr holds texels alone");
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->variant.frame = options.frame;
    request->outputs = options.images;
    auto session = open(options.open);
    if (!session) return session.error();
    if (const auto told = LeftOutNotes().tell(**session, *request); !told) return told;
    const auto run = (*session)->run(*request);
    if (!run) return run.error();
    for (const std::string& name : options.images)
        if (run->tables.contains(name))
            return fail_unnamed(Fault::usage, "'{}' is a table: strata replay --outputs {} --json prints it", name, name);
    for (const std::string& name : options.images)
        if (!run->images.contains(name)) return fail_unnamed(Fault::usage, "the frame has no '{}': its stage is left out", name);
    if (kind == ".png") return write_picture(options, *run);
    return write_exr(options.output, run->images, provenance(**session, *request, *run));
}

}  // namespace strata
