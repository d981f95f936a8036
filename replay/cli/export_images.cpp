// strata export --image: what a stage gave, or a debug view.
#include "capture_format/reader.h"
#include "passes/frame_images.h"
#include "replay/cli/export_kinds.h"
#include "replay/cli/left_out.h"
#include "replay/cli/output_picture.h"
#include "replay/cli/run_json.h"

namespace strata {
namespace {

Result<void> write_picture(const ExportOptions& options, const Run& run) {
    if (run.images.size() != 1)
        return fail(Fault::usage, "export.one_image_per_png", "a .png holds one image, not {images}; write them to an .exr",
                    run.images.size());
    const std::string& image = run.images.begin()->first;
    if (!options.caption) return write_plain_picture(options.output, run, image);
    return write_output_picture(options.output, run, image,
                                fmt::format("{} frame {}", options.open.capture.filename().string(), options.frame));
}

}  // namespace

Result<void> export_images(const ExportOptions& options) {
    const std::string kind = options.output.extension().string();
    if (kind != ".exr" && kind != ".png")
        return fail(Fault::usage, "output.unknown_ending", "images are written as {endings}, not as '{file}'", ".exr or .png",
                    options.output.filename().string());
    if (options.caption && kind == ".exr")
        return fail(Fault::usage, "options.not_applicable", "{option} does not apply: {reason}", "--caption",
                    "an .exr holds texels alone; write a .png");
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
            return fail(Fault::usage, "export.is_table",
                        "'{output}' is a table; strata replay prints it with --outputs and --json", name);
    for (const std::string& name : options.images)
        if (!run->images.contains(name))
            return fail(Fault::usage, "frame.no_output", "frame {frame} has no '{output}': its stage is left out", options.frame,
                        name);
    if (kind == ".png") return write_picture(options, *run);
    return write_exr(options.output, run->images, provenance(**session, *request, *run));
}

}  // namespace strata
