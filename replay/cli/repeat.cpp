#include "replay/cli/repeat.h"

#include "passes/frame_images.h"
#include "replay/expectations/expectation_check.h"

namespace strata {
namespace {

/// What differs first between two runs of one request on the device, or nothing.
std::optional<Error> first_difference(const Run& first, const Run& again, const std::string& device) {
    for (std::size_t i = 0; i < first.passes.size(); ++i)
        for (const auto& [name, image] : first.passes[i].images) {
            const HostImage& other = again.passes[i].images.at(name);
            if (other.texels == image.texels) continue;
            const ImageDeviation deviation = deviation_of(name, other, image);
            const WorstTexel& w = deviation.worst;
            return fail(
                Fault::not_repeatable, "session.not_repeatable",
                "{pass} is the first pass that varies: '{image}' in {differing} of {texels} texels, most at ({x}, {y}) of layer "
                "{layer}, ({red:.9g}, {green:.9g}, {blue:.9g}, {alpha:.9g}) and before ({red_before:.9g}, {green_before:.9g}, "
                "{blue_before:.9g}, {alpha_before:.9g}); on {device}",
                first.passes[i].label, name, deviation.differing, deviation.texels, w.x, w.y, w.layer, w.got.x, w.got.y, w.got.z,
                w.got.w, w.wanted.x, w.wanted.y, w.wanted.z, w.wanted.w, device);
        }
    return {};
}

}  // namespace

Result<void> check_repeats(Session& session, const Request& request, const Run& first, std::size_t repeats) {
    Request everything = request;
    everything.passes = Passes::read_back;
    for (std::size_t repeat = 1; repeat < repeats; ++repeat) {
        const auto again = session.run(everything);
        if (!again) return again.error();
        if (const auto difference = first_difference(first, *again, text(expected_on(session.device()))))
            return within(*difference, "frame {frame}, repeat {repeat} of {repeats}", request.variant.frame, repeat + 1, repeats);
    }
    return {};
}

}  // namespace strata
