// strata accept: the only way expectations are written. Shows what differs from what was expected before, then writes.
#include <algorithm>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "capture_format/expectation_writer.h"
#include "capture_format/reader.h"
#include "passes/frame_images.h"
#include "replay/cli/expected_results.h"
#include "replay/cli/left_out.h"
#include "replay/cli/repeat.h"
#include "replay/cli/verb_options.h"
#include "replay/expectations/expectation_check.h"
#include "replay/json_text.h"
#include "replay/plural.h"
#include "replay/progress_line.h"
#include "replay/revision.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

struct AcceptArguments {
    OpenOptions open;
    ChoiceOptions choices;
    std::string frames;
    std::filesystem::path to;  ///< empty: the capture itself
    bool also = false, with_images = false, dry_run = false, json = false;

    const std::filesystem::path& target() const { return to.empty() ? open.capture : to; }
};

/// What a frame gave beside what was expected of it.
struct Candidate {
    Expectation expectation;
    Run run;
    std::optional<ExpectationVerdict> before;  ///< against what this device was expected to give
    std::size_t accepted = 0;                  ///< results that this device was expected to give
    bool lacks_images = false;                 ///< only hashes of some of its images are kept, and images are wanted

    bool replaces_several() const { return accepted > 1 && !expectation.also; }
    bool is_news() const { return !before || before->agreement != Agreement::exact || replaces_several() || lacks_images; }
};

/// Whether one of the accepted results keeps an image as the new one has it, for every image.
bool keep_images(std::span<const Expectation* const> accepted, const Expectation& got) {
    for (std::size_t i = 0; i < got.passes.size(); ++i)
        for (const ExpectedImage& image : got.passes[i].images) {
            const auto keeps = [&](const ExpectedImage& old) {
                return old.name == image.name && old.hash == image.hash && !old.texels.empty();
            };
            const auto some = [&](const Expectation* each) { return std::ranges::any_of(each->passes[i].images, keeps); };
            if (std::ranges::none_of(accepted, some)) return false;
        }
    return true;
}

Result<Candidate> replay_candidate(Session& session, const Request& request, const AcceptArguments& options,
                                   const ExpectedResults& expected) {
    auto run = session.run(request);
    if (!run) return run.error();
    // What varies can be no expectation.
    if (const auto same = check_repeats(session, request, *run, 2); !same) return same.error();
    Candidate candidate{.expectation = expectation_of(session, request, *run), .run = *std::move(run)};
    candidate.expectation.tool = tool_revision;
    candidate.expectation.also = options.also;
    const auto accepted = accepted_for(expected.expectations, candidate.expectation);
    if (accepted.empty()) return candidate;
    auto verdict = compare_with(expected.capture(session), accepted, candidate.run, candidate.expectation, 0);
    if (!verdict) return verdict.error();
    candidate.before = *std::move(verdict);
    candidate.accepted = accepted.size();
    candidate.lacks_images = options.with_images && !keep_images(accepted, candidate.expectation);
    return candidate;
}

/// Calls each(state, pass, image, hash, sentence) for all images of the frame; the sentence says what of a changed one differs.
template <typename Each>
void for_images(const Candidate& candidate, const Each& each) {
    if (!candidate.before) {
        for (const ExpectedPass& pass : candidate.expectation.passes)
            for (const ExpectedImage& image : pass.images) each("new", pass.label, image.name, image.hash, std::string());
        return;
    }
    for (const ImageVerdict& image : candidate.before->images) {
        if (image.agreement == Agreement::exact) each("same", image.pass, image.image, image.hash, std::string());
        else each("changed", image.pass, image.image, image.hash, sentence(image));
    }
}

void show(const Candidate& candidate) {
    to_stdout("frame {} on {}{}\n", candidate.expectation.frame, text(candidate.expectation.on),
              candidate.replaces_several() ? fmt::format(", replaces {} accepted results", candidate.accepted) : "");
    for_images(candidate, [](const char* state, const auto& pass, const auto& image, const auto& hash, const auto& difference) {
        if (difference.empty()) to_stdout("  {:<8} {:<24} {:<16} {}\n", state, pass, image, hash);
        else to_stdout("  {:<8} {}\n", state, difference);
    });
}

ordered_json json_of(const Candidate& candidate) {
    ordered_json json{{"frame", candidate.expectation.frame},
                      {"on", text(candidate.expectation.on)},
                      {"accepted_results", candidate.accepted},
                      {"images", ordered_json::array()}};
    for_images(candidate, [&](const char* state, const auto& pass, const auto& image, const auto& hash, const auto&) {
        json["images"].push_back({{"state", state}, {"pass", pass}, {"image", image}, {"hash", hash}});
    });
    return json;
}

Result<void> write(ExpectationWriter& writer, Candidate& candidate, const AcceptArguments& options) {
    for (std::size_t i = 0; options.with_images && i < candidate.run.passes.size(); ++i)
        for (ExpectedImage& image : candidate.expectation.passes[i].images)
            image.texels = writer.add_image(candidate.run.passes[i].images.at(image.name).texels);
    return writer.add(as_json(candidate.expectation));
}

Result<void> accept(const AcceptArguments& options) {
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->outputs.clear();
    request->passes = Passes::read_back;
    // Held from before the capture is read: an accept at the same time waits and then reads what this one wrote.
    std::optional<ExpectationWriter> writer;
    if (options.dry_run) {
        if (const auto whole = ExpectationWriter::check(options.target()); !whole) return whole;
    } else {
        auto extended = ExpectationWriter::extend(options.target());
        if (!extended) return extended.error();
        writer = *std::move(extended);
    }
    auto session = open(options.open);
    if (!session) return session.error();
    const auto frames = frame_indices(options.frames, (*session)->frame_count());
    if (!frames) return frames.error();

    const auto expected = expected_results(**session, options.open, options.to, *frames);
    if (!expected) return expected.error();

    std::size_t news = 0;
    ordered_json json{{"schema", "strata.accept"}, {"schema_version", 2}, {"frames", ordered_json::array()}};
    const Progress progress = progress_line();
    LeftOutNotes notes;
    for (const std::size_t frame : *frames) {
        show_frame(progress, json["frames"].size(), frames->size());
        request->variant.frame = frame;
        if (const auto told = notes.tell(**session, *request); !told) return told;
        auto candidate = replay_candidate(**session, *request, options, *expected);
        if (!candidate) return candidate.error();
        json["frames"].push_back(json_of(*candidate));
        if (!options.json) show(*candidate);
        if (!candidate->is_news()) continue;
        ++news;
        if (!writer) continue;
        if (const auto written = write(*writer, *candidate, options); !written) return written;
    }
    if (writer)
        if (const auto finished = writer->finish(); !finished) return finished;
    json["accepted_frames"] = options.dry_run ? 0 : news;
    const std::string file = options.target().string();
    if (options.json) write_stdout(json_text(json));
    else if (news == 0) to_stdout("nothing changed in {}\n", file);
    else if (options.dry_run) to_stdout("{} would be stored anew; {} is not changed (--dry-run)\n", plural(news, "frame"), file);
    else
        to_stdout("stored expected results of {} in {}{}\n", plural(news, "frame"), file,
                  options.with_images ? ", images kept" : "");
    // What ends the program then says that standard output took nothing.
    if (writer && news > 0 && !finish_stdout())
        to_stderr("strata: expected results of {} are stored in {}\n", plural(news, "frame"), file);
    return {};
}

}  // namespace

std::function<Result<void>()> declare_accept(CLI::App& app) {
    const auto options = std::make_shared<AcceptArguments>();
    app.add_option("capture", options->open.capture, "capture (.strata file)")->required()->type_name(extended_file);
    add_options(app, options->open.device);
    add_options(app, options->choices);
    app.add_option("--frames", options->frames, "indices of frames, like 0,4-8; default all");
    app.add_option("--to", options->to, "store the results in this capture instead, such as the one recorded before a change")
        ->type_name(extended_file);
    app.add_flag("--also", options->also, "accept the results beside those accepted before, instead of replacing them");
    app.add_flag("--with-images", options->with_images, "store the images, too; --tolerance and the worst texel need them");
    app.add_flag("--json", options->json, "print JSON instead of text");
    app.add_flag("--dry-run", options->dry_run, "show what would change without writing it");
    return [options] { return accept(*options); };
}

}  // namespace strata
