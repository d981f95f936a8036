// strata export --deep: rasterized in double, tested against the depth that the replay gave.
#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>

#include "capture_format/container/whole_file.h"
#include "capture_format/frame/frame.h"
#include "passes/indirect/volume_light.h"
#include "passes/stage_input.h"
#include "replay/cli/export_kinds.h"
#include "replay/cli/left_out.h"
#include "replay/cli/run_json.h"
#include "replay/deep/deep_image.h"
#include "replay/deep/flatten_deep.h"
#include "replay/plural.h"
#include "replay/scene/shrink_textures.h"
#include "replay/session/loaded_frame.h"

namespace strata {
namespace {

/// Floats in the file, and 1 - A of them, keep this much of a sum of radiance; more is worth a warning.
constexpr double expected_difference = 1e-5;

constexpr std::pair<std::string_view, Transmittance> transmittances[] = {
    {"refused", Transmittance::refused}, {"mean", Transmittance::mean}, {"channels", Transmittance::channels}};

Result<std::uint32_t> sample_of(const ExportOptions& options, std::uint32_t samples) {
    if (!options.sample && samples > 1)
        return fail(
            Fault::usage, "export.choose_sample",
            "a pixel of this frame has {samples} samples and a pixel of a deep image one list: pass --sample 0 to {last}, or "
            "--samples 1",
            samples, samples - 1);
    const std::uint32_t sample = options.sample.value_or(0);
    if (sample >= samples)
        return fail(Fault::usage, "frame.no_sample", "there is no sample {sample}: a pixel has {samples}, numbered from 0",
                    sample, samples);
    return sample;
}

/// How far the file, flattened again, is from the exact blend of the fragments over black, relative to the larger of 1 and it.
Result<double> worst_difference(std::string_view exr, const DeepImage& image) {
    const auto flat = flatten_deep(std::as_bytes(std::span(exr)), "the exported image");
    if (!flat) return flat.error();
    double worst = 0;
    for (std::size_t i = 0; i < image.blend.size(); ++i) {
        const glm::dvec3& wanted = image.blend[i];
        const glm::dvec3 got(
            texel(flat->image, static_cast<std::uint32_t>(i % image.width), static_cast<std::uint32_t>(i / image.width)));
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(got[c] - wanted[c]) / std::max(1.0, std::abs(wanted[c])));
    }
    return worst;
}

}  // namespace

Result<void> export_deep(const ExportOptions& options) {
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->variant.frame = options.frame;
    request->outputs = {"depth_layers", "volume_light"};
    request->once = true;  // to fill the memo, the frame would be executed whole
    auto session = open(options.open);
    if (!session) return session.error();
    if (const auto told = LeftOutNotes().tell(**session, *request); !told) return told;
    auto recorded = (*session)->frame(options.frame);
    if (!recorded) return recorded.error();
    auto loaded = load_frame(*std::move(recorded), request->variant);
    if (!loaded) return loaded.error();
    Frame& frame = (*loaded)->frame;
    shrink_textures(frame, (*session)->device().max_buffer_bytes);
    const auto sample = sample_of(options, frame.view.samples);
    if (!sample) return sample.error();
    const auto run = (*session)->run(*request);
    if (!run) return run.error();

    ImageSet before;
    for (const auto& [name, image] : run->images) before.emplace(name, in_double(image));
    const auto depth = before.find("depth_layers");
    const ReferenceImage opaque =
        depth == before.end() ? ReferenceImage(frame.view.width, frame.view.height, frame.view.samples) : depth->second;
    const auto transmittance =
        std::ranges::find(transmittances, options.transmittance, [](const auto& row) { return row.first; });
    const auto image =
        deep_image(FragmentRows(frame, opaque, indirect::volume_light(frame, before)), *sample, transmittance->second, frame);
    if (!image) return image.error();
    Metadata metadata = provenance(**session, *request, *run);
    metadata["strata.sample"] = fmt::format("{} of {}", *sample, frame.view.samples);
    metadata["strata.transmittance"] = options.transmittance;
    const auto exr = deep_exr(*image, metadata);
    if (!exr) return exr.error();
    Result<void> written;
    Result<double> worst = 0.0;
    oneapi::tbb::parallel_invoke([&] { written = write_whole_file(options.output, *exr); },
                                 [&] { worst = worst_difference(*exr, *image); });
    if (!written) return written;
    if (!worst) return worst.error();
    const bool is_mean = transmittance->second == Transmittance::mean;
    const std::string_view why = *worst <= expected_difference ? ""
                                 : is_mean                     ? ": --transmittance mean makes colored transmittance gray"
                                           : ": light shines through more layers than a float's alpha can tell";
    to_stderr(
        "exported {}; flattened again, the radiance of every pixel is within {:.1e} of the exact blend (relative to the blend, "
        "absolute below 1){}\n",
        plural(image->samples(), "fragment"), *worst, why);
    return {};
}

}  // namespace strata
