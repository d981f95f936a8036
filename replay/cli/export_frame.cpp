// strata export --gltf and --json: what a frame says. No device is needed.
#include "capture_format/codec/frame_json.h"
#include "capture_format/container/whole_file.h"
#include "capture_format/export/gltf.h"
#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "replay/cli/export_kinds.h"

namespace strata {
namespace {

Result<Frame> recorded_frame(const ExportOptions& options) {
    const Partial partial = options.open.allow_partial ? Partial::allowed : Partial::refused;
    return open_capture(options.open.capture, partial, options.open.device.memory_budget).and_then([&](auto& capture) {
        return capture.frame(options.frame);
    });
}

}  // namespace

Result<void> export_scene(const ExportOptions& options) {
    const auto frame = recorded_frame(options);
    if (!frame) return frame.error();
    const auto warnings = export_gltf(*frame, options.output);
    if (!warnings) return warnings.error();
    for (const std::string& warning : *warnings) to_stderr("strata: warning: {}\n", warning);
    return {};
}

Result<void> export_json(const ExportOptions& options) {
    const auto frame = recorded_frame(options);
    if (!frame) return frame.error();
    const auto json = frame_json(*frame);
    return json ? write_whole_file(options.output, *json) : json.error();
}

}  // namespace strata
