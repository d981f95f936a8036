// Two runs of a frame, or a frame and images, side by side: a verdict for every pass and image, the first pass that differs, and
// in it the first step.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "replay/difference/compare_images.h"
#include "replay/session/session.h"
#include "replay/tables/sheet.h"

namespace strata {

inline constexpr std::string_view label_of_files = "images";

/// A pass of a stage in both runs, or the images of two files.
struct PassComparison {
    std::string label;               ///< "transparency", "combine at film", or label_of_files
    std::string choice_a, choice_b;  ///< "technique key=value ..."
    std::vector<ImageComparison> images;
};

/// Where two runs part.
struct Divergence {
    std::string pass, image;  ///< empty: nowhere
    std::string step;         ///< "step 12, shaders/x.comp, writes 'image' (3, 4) ...", or why no step can be named
};

struct FrameComparison {
    std::size_t frame = 0;
    std::vector<PassComparison> passes;
    Divergence divergence;
    Verdict verdict = Verdict::same;  ///< the worst of all
    std::vector<std::string> notes = {};
};

/// Notes the pass's verdicts, and the first that is over tolerance. FLIP's maps have been seen by now; those of many frames would
/// fill the memory.
void add_pass(FrameComparison&, PassComparison);

/// A side of a comparison in words.
struct Side {
    std::string name;                          ///< of the file
    std::string capture, device, driver, cpu;  ///< empty for images
    std::string asked = {};                    ///< techniques and settings that were asked for: "transparency/weighted"
};

struct Comparison {
    Side a, b;
    ErrorLimits limits;
    std::vector<FrameComparison> frames;
    std::string tool, rerun;  ///< "strata REVISION", the command line
    std::string date = {};    ///< utc_date()
};

/// A run to compare: a session and what to ask of it. Both sides may be one session.
struct RunToCompare {
    Session& session;
    const Request& request;
};

/// The images of a comparison while they are there, for pictures of them.
using SeeImages =
    std::function<Result<void>(const PassComparison&, const ImageComparison&, const HostImage& a, const HostImage& b)>;

/// Pass by pass. Fails when images that should have one shape do not.
Result<FrameComparison> compare_runs(const RunToCompare& a, const RunToCompare& b, const ErrorLimits&, const SeeImages&);

/// By name; one image on each side is compared whatever its name, also where the limits ask for others. Fails where a name is on
/// one side only.
Result<FrameComparison> compare_image_sets(const NamedImages& a, const NamedImages& b, const ErrorLimits&, const SeeImages&);

/// The worst verdict of all frames.
Verdict verdict(const Comparison&);

/// A row for every image of every pass.
Sheet sheet_of(const Comparison&);
Page page_of(const Comparison&);
std::string as_text(const Comparison&);
std::string as_json(const Comparison&);
std::string as_csv(const Comparison&);
/// JUnit's XML: a suite per frame, a case per pass and image. `artifacts` gives a case's files.
std::string as_junit(const Comparison&, const std::map<std::string, std::string>& artifacts);
/// "f0003.transparency.color": what files and cases are called by.
std::string case_name(std::size_t frame, const PassComparison&, const ImageComparison&);

}  // namespace strata
