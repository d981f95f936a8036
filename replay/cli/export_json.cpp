// strata export --json: no device is needed.
#include "capture_format/frame_json.h"
#include "capture_format/reader.h"
#include "capture_format/whole_file.h"
#include "replay/cli/export_kinds.h"

namespace strata {

Result<void> export_json(const ExportOptions& options) {
    const auto capture = Capture::open(options.open.capture, options.open.allow_partial ? Partial::allowed : Partial::refused);
    if (!capture) return capture.error();
    const auto frame = capture->frame(options.frame);
    if (!frame) return frame.error();
    const auto json = frame_json(*frame);
    return json ? write_whole_file(options.output, *json) : json.error();
}

}  // namespace strata
