#include "replay/cli/report_needs.h"

#include "capture_format/container/whole_file.h"
#include "replay/cli/given_options.h"
#include "replay/cli/left_out.h"
#include "replay/progress_line.h"
#include "replay/report/needs.h"
#include "replay/session/eye_move.h"

namespace strata {
namespace {

std::string written(OutputFormat format, std::span<const Needs> made) {
    if (format == OutputFormat::json) return as_json(made);
    if (format == OutputFormat::csv) return as_csv(made);
    return format == OutputFormat::markdown ? as_markdown(page_of(made)) : as_text(made);
}

}  // namespace

Result<void> report_needs(const NeedsArguments& options) {
    auto request = request_of(options.choices);
    if (!request) return request.error();
    const auto eye = eye_move_of(options.eye);
    if (!eye) return eye.error();
    request->variant.eye = *eye;
    const StopAtSignal signal;
    const Progress progress = progress_line();
    LeftOutNotes notes;
    std::vector<Needs> made;
    for (const std::filesystem::path& capture : options.captures) {
        OpenOptions one = options.open;
        one.capture = capture;
        auto session = open(one);
        if (!session) return session.error();
        (*session)->stop_when(signal.token());
        const auto frames = frame_indices(options.frames, (*session)->frame_count());
        if (!frames) return frames.error();
        for (const std::size_t frame : *frames) {
            request->variant.frame = frame;
            if (const auto told = notes.tell(**session, *request); !told) return told;
            auto needs = measure_needs(**session, *request, options.repeats, progress);
            if (!needs) return needs.error();
            needs->capture_name = capture.filename().string();
            needs->date = date_of_output();
            made.push_back(*std::move(needs));
        }
    }
    return write_text(options.output, written(file_format(options.output, OutputFormat::text), made));
}

}  // namespace strata
