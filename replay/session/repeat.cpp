#include "replay/session/repeat.h"

#include "replay/expectations/expectation_check.h"

namespace strata {
namespace {

/// What differs first between two runs of one request, or nothing.
std::optional<std::string> first_difference(const Run& first, const Run& again) {
    for (std::size_t i = 0; i < first.acts.size(); ++i)
        for (const auto& [name, image] : first.acts[i].images) {
            const HostImage& other = again.acts[i].images.at(name);
            if (other.texels == image.texels) continue;
            const ImageDeviation deviation = deviation_of(name, other, image);
            const WorstTexel& w = deviation.worst;
            return fmt::format(
                "{} is the first pass that varies: '{}' in {} of {} texels, most at ({}, {}) of layer {}, "
                "({:.9g}, {:.9g}, {:.9g}, {:.9g}) and before ({:.9g}, {:.9g}, {:.9g}, {:.9g})",
                first.acts[i].label, name, deviation.differing, deviation.texels, w.x, w.y, w.layer, w.got.x, w.got.y, w.got.z,
                w.got.w, w.wanted.x, w.wanted.y, w.wanted.z, w.wanted.w);
        }
    return {};
}

}  // namespace

Result<void> check_repeats(Session& session, const Request& request, const Run& first, std::size_t repeats) {
    Request everything = request;
    everything.acts = Acts::brought_back;
    for (std::size_t repeat = 1; repeat < repeats; ++repeat) {
        const auto again = session.run(everything);
        if (!again) return again.error();
        if (const auto difference = first_difference(first, *again))
            return fail_unnamed(Fault::not_repeatable, "frame {}, repeat {} of {}: {}; on {}", request.variant.frame, repeat + 1,
                                repeats, *difference, text(expected_on(session.device())));
    }
    return {};
}

}  // namespace strata
