// strata diff: two captures, two ways to replay one, two devices, a capture and images, or two images: what differs, where, by
// how much.
#include <array>
#include <charconv>
#include <limits>
#include <memory>
#include <set>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "capture_format/container/kept_files.h"
#include "capture_format/container/whole_file.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/cli/given_options.h"
#include "replay/cli/left_out.h"
#include "replay/cli/output_picture.h"
#include "replay/cli/table_output.h"
#include "replay/cli/verb_options.h"
#include "replay/difference/comparison.h"
#include "replay/difference/page/difference_page.h"
#include "replay/difference/picture.h"
#include "replay/images/image_io.h"
#include "replay/plural.h"
#include "replay/progress_line.h"
#include "replay/report/compare_with_truth.h"
#include "replay/revision.h"

namespace strata {
namespace {

/// What one side may say for itself.
struct SideOptions {
    std::filesystem::path file;
    std::string gpu;
    std::vector<std::string> uses, sets;
};

struct DiffArguments {
    SideOptions a, b;
    ChoiceOptions both;  ///< but for --use and --set, which are B's
    DeviceChoice device;
    bool allow_partial = false;
    TableOutput printed;
    std::string frames, rerun;
    ErrorLimits limits;
    std::vector<std::string> ignored;
    std::filesystem::path junit, output;  ///< output: a folder for pictures, or a page
    std::string error_at, stage;          ///< the truth in place of A
    const CLI::App* app = nullptr;        ///< what was given
};

enum class FileKind { capture, exr, png };

FileKind kind_of(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".exr" || ending == ".EXR"   ? FileKind::exr
           : ending == ".png" || ending == ".PNG" ? FileKind::png
                                                  : FileKind::capture;
}

/// What comparing two pixels takes beside the images: both as planes of floats, and FLIP's filters. Two of 4096 x 4096 took 90.
constexpr std::uint64_t bytes_per_compared_pixel = 96;

Result<NamedImages> read_images(const std::filesystem::path& file, MemoryBudget& budget) {
    if (kind_of(file) == FileKind::exr) return read_exr(file, budget);
    auto image = read_png(file, budget);
    if (!image) return image.error();
    NamedImages images;
    images.emplace("image", *std::move(image));
    return images;
}

/// "transparency/weighted weight=w9".
std::string asked_choices(const SideOptions& side) {
    std::vector<std::string> asked = side.uses;
    asked.insert(asked.end(), side.sets.begin(), side.sets.end());
    return asked.empty() ? "as recorded" : fmt::format("{}", fmt::join(asked, " "));
}

/// Whether the output is a page, not a folder.
bool is_page(const std::filesystem::path& output) { return output.extension() == ".html"; }

/// Writes the pictures of what differs and removes those of what no longer does; or keeps them for a page.
class Pictures {
public:
    explicit Pictures(const DiffArguments& options) : options_(options) {}

    Result<void> see(std::size_t frame, const PassComparison& pass, const ImageComparison& made, const HostImage& a,
                     const HostImage& b) {
        if (options_.output.empty()) return {};
        if (is_page(options_.output)) {
            of_page_.add(frame, pass, made, a, b);
            return {};
        }
        const std::string name = case_name(frame, pass, made);
        const auto path = options_.output / fmt::format("{}.{}.diff.png", options_.a.file.stem().string(), name);
        if (made.verdict < Verdict::warning) {
            if (const auto free = check_not_kept(path); !free) return free;
            std::error_code problem;
            if (std::filesystem::remove(path, problem)) to_stderr("removed {}\n", path.string());
            return problem ? Result<void>(fail(Fault::usage, "file.cannot_remove", "cannot remove {file}: {reason}",
                                               path.string(), problem.message()))
                           : Result<void>();
        }
        const auto side = [&](const SideOptions& of, const std::string& choice) {
            return pass.choice_a == pass.choice_b ? asked_of(of) : without_defaults(choice);
        };
        const Canvas canvas =
            difference_picture(made, a, b,
                               {fmt::format("frame {}  {}: {}  {}", frame, pass.label, made.image,
                                            made.verdict == Verdict::over ? "over tolerance" : strata::name(made.verdict)),
                                side(options_.a, pass.choice_a), side(options_.b, pass.choice_b)});
        if (const auto done = write_png(path, canvas); !done) return done;
        to_stderr("wrote {}\n", path.string());
        artifacts_[name] = path.string();
        return {};
    }

    const std::map<std::string, std::string>& artifacts() const { return artifacts_; }
    const PagePictures& of_page() const { return of_page_; }

private:
    /// What a side is besides a pass that both sides run alike: its file, or what it was asked to use of the file that both have.
    std::string asked_of(const SideOptions& side) const {
        if (options_.a.file != options_.b.file) return side.file.filename().string();
        const std::string device = side.gpu.empty() ? "on the default device" : "on " + side.gpu;
        return asked_choices(side) + (options_.a.gpu != options_.b.gpu ? " " + device : "");
    }

    const DiffArguments& options_;
    std::map<std::string, std::string> artifacts_;
    PagePictures of_page_;
};

SeeImages seeing(Pictures& pictures, std::size_t frame) {
    return [&pictures, frame](const PassComparison& pass, const ImageComparison& made, const HostImage& a, const HostImage& b) {
        return pictures.see(frame, pass, made, a, b);
    };
}

Result<std::unique_ptr<Session>> open_side(const DiffArguments& options, const SideOptions& side) {
    DeviceChoice device = options.device;
    if (!side.gpu.empty()) device.gpu = side.gpu;
    return open(OpenOptions{side.file, device, options.allow_partial});
}

Result<Request> request_of_side(const DiffArguments& options, const SideOptions& side) {
    ChoiceOptions choices = options.both;
    choices.uses = side.uses;
    choices.sets = side.sets;
    return request_of(choices);
}

Side describe(const SideOptions& side, const Session& session) {
    const DeviceInfo& device = session.device();
    return {side.file.filename().string(),
            session.capture_id(),
            device.name,
            device.driver + " " + device.driver_version,
            device.cpu,
            asked_choices(side)};
}

/// Both captures, or one capture two ways. One session serves both where file and device are the same.
Result<void> compare_captures(const DiffArguments& options, Pictures& pictures, Comparison& comparison) {
    auto request_a = request_of_side(options, options.a), request_b = request_of_side(options, options.b);
    if (!request_a) return request_a.error();
    if (!request_b) return request_b.error();
    const auto session_a = open_side(options, options.a);
    if (!session_a) return session_a.error();
    const bool shared = options.a.file == options.b.file && options.a.gpu == options.b.gpu;
    auto opened_b = shared ? Result<std::unique_ptr<Session>>(std::unique_ptr<Session>()) : open_side(options, options.b);
    if (!opened_b) return opened_b.error();
    Session &a = **session_a, &b = shared ? a : **opened_b;
    comparison.a = describe(options.a, a);
    comparison.b = describe(options.b, b);
    if (options.frames.empty() && a.frame_count() != b.frame_count())
        return fail(Fault::usage, "diff.frame_counts_differ",
                    "the captures have different numbers of frames, A {frames_a} and B {frames_b}; choose frames with --frames",
                    a.frame_count(), b.frame_count());
    const auto frames = frame_indices(options.frames, std::min(a.frame_count(), b.frame_count()));
    if (!frames) return frames.error();
    const Progress progress = progress_line();
    LeftOutNotes notes;
    for (const std::size_t frame : *frames) {
        show_frame(progress, comparison.frames.size(), frames->size());
        request_a->variant.frame = request_b->variant.frame = frame;
        const auto told = notes.tell(a, *request_a).and_then([&] { return notes.tell(b, *request_b); });
        if (!told) return told;
        auto made = compare_runs({a, *request_a}, {b, *request_b}, options.limits, seeing(pictures, frame));
        if (!made) return within(made.error(), "frame {frame}", frame);
        comparison.frames.push_back(*std::move(made));
    }
    return {};
}

/// --stage, or the one stage that --use and --set name.
Result<Stage> stage_of_truth(const DiffArguments& options, const Request& request) {
    if (!options.stage.empty()) return stage_called(options.stage);
    std::set<Stage> named;
    for (const Technique* technique : request.choices.techniques)
        if (technique) named.insert(technique->stage);
    for (const SettingChange& change : request.choices.settings)
        if (change.technique) named.insert(change.technique->stage);
    if (named.size() == 1) return *named.begin();
    return fail(Fault::usage, "diff.choose_stage",
                "--error-at {at} needs one stage; --use and --set name {stages}. Choose one with --stage", options.error_at,
                named.empty() ? "none" : std::to_string(named.size()));
}

/// One capture, and in place of A the truth of a stage.
Result<void> compare_with_truths(const DiffArguments& options, Pictures& pictures, Comparison& comparison) {
    auto request = request_of_side(options, options.b);
    if (!request) return request.error();
    const auto stage = stage_of_truth(options, *request);
    if (!stage) return stage.error();
    const auto session = open_side(options, options.b);
    if (!session) return session.error();
    const auto frames = frame_indices(options.frames, (*session)->frame_count());
    if (!frames) return frames.error();
    const ErrorAt at = options.error_at == "picture" ? ErrorAt::picture : ErrorAt::stage;
    comparison.b = describe(options.b, **session);
    const Progress progress = progress_line();
    LeftOutNotes notes;
    for (const std::size_t frame : *frames) {
        show_frame(progress, comparison.frames.size(), frames->size());
        request->variant.frame = frame;
        if (const auto told = notes.tell(**session, *request); !told) return told;
        auto made = compare_with_truth({**session, *request}, *stage, at, options.limits, seeing(pictures, frame));
        if (!made) return within(made.error(), "frame {frame}", frame);
        comparison.a = {.name = made->truth};
        comparison.frames.push_back(std::move(made->frame));
    }
    return {};
}

/// Images are compared one after the other.
Result<void> check_room(const NamedImages& images, const MemoryBudget& budget) {
    for (const auto& [name, image] : images) {
        const Extent& extent = image.shape.extent;
        const std::uint64_t pixels = std::uint64_t{extent.width} * extent.height * image.shape.layers;
        if (const auto room = budget.has_room(pixels, bytes_per_compared_pixel, fmt::format("comparing '{}'", name)); !room)
            return room;
    }
    return {};
}

/// Limits on what none of the images holds.
Result<void> check_limits(const NamedImages& images, const CLI::App& app) {
    bool has_depth = false, has_radiance = false, has_light = false;
    for (const auto& [name, image] : images) {
        const Content content = content_of(name, image.shape.format);
        has_depth = has_depth || content == Content::depth;
        has_radiance = has_radiance || content == Content::radiance;
        has_light = has_light || content == Content::radiance || content == Content::display;
    }
    const auto fits = [&](bool has, std::initializer_list<const char*> options, std::string_view why) {
        return has ? Result<void>() : check_not_given(app, options, why);
    };
    return fits(has_depth, {"--ulps"}, "none of the images is depth")
        .and_then([&] {
            return fits(has_radiance, {"--tone-mapper", "--exposures"}, "no image holds radiance, whose tones FLIP maps");
        })
        .and_then([&] {
            return fits(has_light, {"--flip-limit", "--ppd"}, "no image holds light, which FLIP compares");
        });
}

/// A capture's side and that of the file whose images it is compared with.
struct MixedSides {
    const SideOptions &replayed, &file;
};

/// The images of a file and the capture's own of the same names, made now. Either may be A, to which errors are relative.
Result<void> compare_with_images(const DiffArguments& options, const MixedSides& sides, Pictures& pictures,
                                 Comparison& comparison) {
    const std::string file = sides.file.file.string();
    if (kind_of(sides.file.file) == FileKind::png)
        return fail(Fault::usage, "diff.png_with_capture",
                    "{file} is a PNG; a capture can only be compared with the EXR of a replay, whose images have names", file);
    MemoryBudget budget(options.device.memory_budget);
    const auto images = read_images(sides.file.file, budget);
    if (!images) return images.error();
    if (const auto room = check_room(*images, budget); !room) return room;
    if (const auto fits = check_limits(*images, *options.app); !fits) return fits;
    auto request = request_of_side(options, sides.replayed);
    if (!request) return request.error();
    const auto session = open_side(options, sides.replayed);
    if (!session) return session.error();
    const auto frames = frame_indices(options.frames, (*session)->frame_count());
    if (!frames) return frames.error();
    if (frames->size() != 1)
        return fail(Fault::usage, "diff.choose_frame",
                    "{file} has the images of one frame, and {frames} frames of the capture are chosen; choose one with --frames",
                    file, frames->size());
    request->variant.frame = frames->front();
    request->outputs.clear();
    for (const auto& [name, image] : *images) request->outputs.push_back(name);
    if (const auto told = LeftOutNotes().tell(**session, *request); !told) return told;
    const auto run = (*session)->run(*request);
    if (!run) return run.error();
    const bool file_is_a = &sides.file == &options.a;
    const Side replayed = describe(sides.replayed, **session), of_file{.name = sides.file.file.filename().string()};
    comparison.a = file_is_a ? of_file : replayed;
    comparison.b = file_is_a ? replayed : of_file;
    const NamedImages &a = file_is_a ? *images : run->images, &b = file_is_a ? run->images : *images;
    auto made = compare_image_sets(a, b, options.limits, seeing(pictures, request->variant.frame));
    if (!made) return made.error();
    made->frame = request->variant.frame;
    comparison.frames.push_back(*std::move(made));
    return {};
}

Result<void> compare_files(const DiffArguments& options, Pictures& pictures, Comparison& comparison) {
    if (kind_of(options.a.file) != kind_of(options.b.file))
        return fail(Fault::usage, "diff.file_types_differ",
                    "an EXR holds linear light and a PNG display values; compare two files of one type");
    MemoryBudget budget(options.device.memory_budget);
    const auto a = read_images(options.a.file, budget);
    if (!a) return a.error();
    const auto b = read_images(options.b.file, budget);
    if (!b) return b.error();
    if (const auto room = check_room(*a, budget); !room) return room;
    if (const auto fits = check_limits(*a, *options.app); !fits) return fits;
    comparison.a = {.name = options.a.file.filename().string()};
    comparison.b = {.name = options.b.file.filename().string()};
    auto made = compare_image_sets(*a, *b, options.limits, seeing(pictures, 0));
    if (!made) return made.error();
    comparison.frames.push_back(*std::move(made));
    return {};
}

Result<void> compare(const DiffArguments& options, Pictures& pictures, Comparison& comparison) {
    const bool a_is_capture = kind_of(options.a.file) == FileKind::capture,
               b_is_capture = kind_of(options.b.file) == FileKind::capture;
    if (!options.error_at.empty()) return compare_with_truths(options, pictures, comparison);
    if (a_is_capture && b_is_capture) return compare_captures(options, pictures, comparison);
    if (a_is_capture) return compare_with_images(options, {.replayed = options.a, .file = options.b}, pictures, comparison);
    if (b_is_capture) return compare_with_images(options, {.replayed = options.b, .file = options.a}, pictures, comparison);
    return compare_files(options, pictures, comparison);
}

/// The first thing that is over tolerance, as a sentence.
Error over_tolerance(const Comparison& comparison) {
    for (const FrameComparison& frame : comparison.frames)
        for (const PassComparison& pass : frame.passes)
            for (const ImageComparison& image : pass.images)
                if (image.verdict == Verdict::over)
                    return fail(Fault::over_tolerance, "diff.over_tolerance", "frame {frame}: {pass}: {image}: {reason}",
                                frame.frame, pass.label, image.image, image.reason);
    return fail(Fault::over_tolerance, "diff.over_tolerance", "over tolerance");
}

/// "100,40,32x16".
Result<PixelBox> box_of(const std::string& text) {
    PixelBox box;
    const std::array numbers{&box.x, &box.y, &box.width, &box.height};
    constexpr std::string_view between = ",,x";
    const char *at = text.data(), *end = at + text.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto [next, problem] = std::from_chars(at, end, *numbers[i]);
        const bool is_last = i + 1 == numbers.size();
        if (problem != std::errc() || (is_last ? next != end : next == end || *next != between[i])) break;
        if (is_last && box.width > 0 && box.height > 0) return box;
        at = next + 1;
    }
    return fail(Fault::usage, "options.malformed", "{option} takes {form}, not '{value}'", "--ignore",
                "X,Y,WIDTHxHEIGHT or a .png", text);
}

/// --ignore: boxes add up, and so do masks, which are of one size.
Result<void> read_ignored(const DiffArguments& options, IgnoredPixels& ignored) {
    MemoryBudget budget(options.device.memory_budget);
    for (const std::string& text : options.ignored) {
        if (kind_of(text) != FileKind::png) {
            const auto box = box_of(text);
            if (!box) return box.error();
            ignored.boxes.push_back(*box);
            continue;
        }
        const auto mask = read_png(text, budget);
        if (!mask) return mask.error();
        const Extent& extent = mask->shape.extent;
        const std::size_t pixels = std::size_t(extent.width) * extent.height;
        if (ignored.mask.empty()) {
            ignored.mask_width = extent.width, ignored.mask_height = extent.height;
            ignored.mask.resize(pixels);
        }
        if (ignored.mask_width != extent.width || ignored.mask_height != extent.height)
            return fail(Fault::usage, "diff.masks_differ", "the masks of --ignore differ in size: {file} is {width} x {height}",
                        text, extent.width, extent.height);
        for (std::size_t i = 0; i < pixels; ++i)
            if (texel(*mask, std::uint32_t(i % extent.width), std::uint32_t(i / extent.width)).x >= .5) ignored.mask[i] = true;
    }
    return {};
}

/// Fails where --images names one that was not compared, or --ignore nothing that was.
Result<void> check_chosen(const Comparison& comparison) {
    std::set<std::string> compared;
    std::uint64_t ignored = 0;
    bool is_one_image = false;  // of two files, whose name does not matter
    for (const FrameComparison& frame : comparison.frames)
        for (const PassComparison& pass : frame.passes) {
            is_one_image = pass.label == label_of_files && pass.images.size() == 1;
            for (const ImageComparison& image : pass.images) {
                compared.insert(image.image);
                ignored += image.error.ignored;
            }
        }
    if (!comparison.limits.ignored.is_empty() && ignored == 0)
        return fail(Fault::usage, "diff.ignores_nothing", "--ignore covers no pixel of the images that are compared");
    if (is_one_image) return {};
    for (const std::string& image : comparison.limits.images)
        if (!compared.contains(image))
            return fail(Fault::usage, "diff.no_such_image", "--images {image}: neither A nor B has an image of this name", image);
    return {};
}

/// Whether something is said of B: the same two ways of replaying give the same, but a device may be compared with itself.
bool has_a_side_b(const DiffArguments& options) {
    return !options.b.gpu.empty() || options.a.uses != options.b.uses || options.a.sets != options.b.sets ||
           options.a.gpu != options.b.gpu;
}

/// With --error-at A is a truth.
Result<void> check_options_beside_truth(const DiffArguments& options) {
    const std::string_view why = "with --error-at A is the truth of B";
    if (kind_of(options.a.file) != FileKind::capture)
        return fail(Fault::usage, "diff.no_truth_of_image",
                    "--error-at compares a capture with its truth, and {file} is an image", options.a.file.string());
    return check_not_given(*options.app, {"B", "--use-a", "--set-a", "--gpu-a", "--gpu-b"}, why);
}

/// What is said of replaying where one side or both are images, and what is missing where there is one file.
Result<void> check_options(const DiffArguments& options) {
    const CLI::App& app = *options.app;
    if (options.limits.flip_mean && !options.limits.limit)
        if (const auto fits = check_not_given(app, {"--percent"}, "with --flip-limit and without --limit FLIP alone decides");
            !fits)
            return fits;
    if (!options.error_at.empty()) return check_options_beside_truth(options);
    const auto is_image = [](const std::filesystem::path& file) { return !file.empty() && kind_of(file) != FileKind::capture; };
    if (options.b.file.empty() && is_image(options.a.file))
        return fail(Fault::usage, "diff.nothing_to_compare",
                    "{file} is an image and cannot be replayed: name a second image to compare it with", options.a.file.string());
    if (options.b.file.empty() && !has_a_side_b(options))
        return fail(Fault::usage, "diff.nothing_to_compare",
                    "there is nothing to compare A with: name a second file, or options of B (--use, --set, --gpu-b)");
    const bool a_is_image = is_image(options.a.file), b_is_image = is_image(options.b.file);
    if (b_is_image)
        if (const auto fits = check_not_given(app, {"--use", "--set", "--gpu-b"}, "B is an image and not replayed"); !fits)
            return fits;
    if (a_is_image)
        if (const auto fits = check_not_given(app, {"--use-a", "--set-a", "--gpu-a"}, "A is an image and not replayed"); !fits)
            return fits;
    if (!a_is_image || !b_is_image) return {};
    return check_not_given(app, {"--force", "--samples", "--gpu", "--without", "--validation", "--allow-partial", "--frames"},
                           "two images are compared and nothing is replayed");
}

Result<void> diff(DiffArguments options) {
    if (options.b.file.empty()) options.b.file = options.a.file;
    if (const auto read = read_ignored(options, options.limits.ignored); !read) return read;
    if (!options.output.empty() && !is_page(options.output))
        if (const auto made = make_folder(options.output); !made) return made;
    Pictures pictures(options);
    Comparison comparison{.limits = options.limits, .tool = fmt::format("strata {}", tool_revision), .rerun = options.rerun};
    if (const auto done = compare(options, pictures, comparison); !done) return done;
    if (const auto known = check_chosen(comparison); !known) return known;
    comparison.date = date_of_output();
    write_stdout(in_format(printed_format(options.printed), comparison));
    if (!options.junit.empty())
        if (const auto done = write_whole_file(options.junit, as_junit(comparison, pictures.artifacts())); !done) return done;
    if (is_page(options.output))
        if (const auto done = write_whole_file(options.output, as_html(comparison, pictures.of_page())); !done) return done;
    return verdict(comparison) == Verdict::over ? Result<void>(over_tolerance(comparison)) : Result<void>();
}

void add_sides(CLI::App& app, DiffArguments& options) {
    app.add_option("A", options.a.file, "reference, to which errors are relative: a .strata capture, or an .exr or .png image")
        ->required()
        ->type_name(input_file);
    app.add_option("B", options.b.file, "image or capture to compare; default: A replayed with the --*-b options")
        ->type_name(input_file);
    const auto list = [&](const char* name, std::vector<std::string>& to, const char* help) {
        app.add_option(name, to, help)->allow_extra_args(false);
    };
    list("--use,--use-b", options.b.uses, "technique for B as stage/technique; repeatable");
    list("--set,--set-b", options.b.sets, "parameter for B as key=value or stage/technique:key=value; repeatable");
    list("--use-a", options.a.uses, "technique for A as stage/technique; repeatable");
    list("--set-a", options.a.sets, "parameter for A as key=value or stage/technique:key=value; repeatable");
    list("--force", options.both.force, "turn on a feature that the frames of A and B lack, or 'all'");
    app.add_option("--samples", options.both.samples, "replace the recorded samples per pixel of A and B")->check(one_or_four());
    add_options(app, options.device);
    app.add_option("--gpu-a", options.a.gpu, "device for A; default that of --gpu");
    app.add_option("--gpu-b", options.b.gpu, "device for B; default that of --gpu");
    app.add_option(
           "--error-at", options.error_at,
           "compare with the truth of a stage instead of A: the light that it makes (stage), or the picture that the later "
           "stages make of it (picture)")
        ->check(one_of({"stage", "picture"}));
    app.add_option("--stage", options.stage,
                   "stage whose truth --error-at compares with; default: the one that --use and --set name")
        ->needs("--error-at");
    app.add_flag("--allow-partial", options.allow_partial, "read the complete frames of a truncated file");
    app.add_option("--frames", options.frames, "indices of frames, like 0,4-8; default all");
}

/// "START,STOP" or "START,STOP,COUNT".
void read_exposures(const std::string& text, std::optional<ExposureRange>& exposures) {
    const auto refuse = [&](const char* form) {
        throw RefusedValue{fail(Fault::usage, "options.malformed", "takes {form}, not '{value}'", form, text)};
    };
    std::vector<double> numbers;
    for (const std::string& part : CLI::detail::split(text, ',')) {
        double number = 0;
        if (!CLI::detail::lexical_cast(part, number) || !(std::abs(number) <= 100)) refuse("exposures from -100 to 100");
        numbers.push_back(number);
    }
    if (numbers.size() < 2 || numbers.size() > 3) refuse("START,STOP or START,STOP,COUNT");
    exposures = exposure_range(numbers[0], numbers[1]);
    if (numbers[1] < numbers[0]) refuse("a STOP that is not below START");
    if (numbers.size() == 2) return;
    if (numbers[2] < 1 || numbers[2] != std::floor(numbers[2])) refuse("a whole COUNT from 1 to 100");
    exposures->count = static_cast<std::uint32_t>(numbers[2]);
}

void add_flip(CLI::App& app, FlipOptions& flip) {
    app.add_option("--ppd", flip.pixels_per_degree,
                   "pixels per degree of visual angle for FLIP; default 67.02, a 4K screen at 0.7 m")
        ->check(from_to(1, 1000));
    std::map<std::string, ToneMapper> mappers;
    for (std::size_t i = 0; i < tone_mapper_names.size(); ++i) mappers.emplace(tone_mapper_names[i], static_cast<ToneMapper>(i));
    app.add_option_function<std::string>(
           "--tone-mapper", [&flip, mappers](const std::string& text) { flip.tone_mapper = mappers.at(text); },
           "tone mapper for FLIP of radiance: aces (default), hable or reinhard")
        ->check(one_of({tone_mapper_names.begin(), tone_mapper_names.end()}));
    app.add_option_function<std::string>(
           "--exposures", [](const std::string&) {},
           "exposures for FLIP of radiance in stops, as START,STOP or START,STOP,COUNT; default: from the brightest to "
           "the median pixel of A, one per stop")
        ->type_name("LIST")
        ->check([&flip](const std::string& text) {
            read_exposures(text, flip.exposures);
            return std::string();
        });
}

void add_limits(CLI::App& app, ErrorLimits& limits) {
    app.add_option("--limit", limits.limit, "largest difference of a pixel in any channel that still passes, default 0")
        ->check(not_negative());
    app.add_option("--percent", limits.percent, "largest percentage of pixels above --limit that still passes, default 0")
        ->check(from_to(0, 100));
    app.add_option("--hard-limit", limits.hard_limit, "largest difference of any pixel, whatever --percent allows; default: none")
        ->check(not_negative());
    CLI::Option* warn =
        app.add_option("--warn-limit", limits.warn_limit, "like --limit, but only warns; default: none")->check(not_negative());
    app.add_option("--warn-percent", limits.warn_percent, "like --percent, but only warns; default 0")
        ->check(from_to(0, 100))
        ->needs(warn);
    app.add_option("--ulps", limits.ulps,
                   "largest difference of depth images that still passes, in units in the last place (ULPs), default 0; integer "
                   "images must be equal")
        ->check(from_to(0, std::numeric_limits<std::uint32_t>::max()));
    app.add_option(
           "--region", limits.region,
           "largest percentage of any 16 x 16 pixels above --limit that still passes: a small defect that --percent allows")
        ->check(from_to(0, 100))
        ->needs("--limit");
    app.add_option("--images", limits.images, "images to compare, like display,color; default all")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--flip-limit", limits.flip_mean,
                   "largest mean FLIP of images of light, and largest mean difference of alpha where it is coverage; without "
                   "--limit, only these are checked for them")
        ->check(from_to(0, 1));
    add_flip(app, limits.flip);
}

}  // namespace

std::function<Result<void>()> declare_diff(CLI::App& app) {
    const auto options = std::make_shared<DiffArguments>();
    add_sides(app, *options);
    add_limits(app, options->limits);
    app.add_option("--ignore", options->ignored,
                   "pixels that are not compared: a box as X,Y,WIDTHxHEIGHT, or a PNG that is white there; repeatable")
        ->allow_extra_args(false);
    app.add_option("--junit", options->junit, "write JUnit XML to this file: one suite per frame, one case per pass and image")
        ->type_name(output_file);
    app.add_option(
           "-o,--output", options->output,
           "write pictures of the differences to this folder, outdated ones in it are removed; or, where it ends in .html, one "
           "page with all of it")
        ->type_name(output_folder);
    add_formats(app, options->printed);
    return [options, &app] {
        options->rerun = command_line(app);
        options->app = &app;
        return check_options(*options).and_then([&] { return diff(*options); });
    };
}

}  // namespace strata
