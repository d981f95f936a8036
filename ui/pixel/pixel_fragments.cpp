#include "ui/pixel/pixel_fragments.h"

#include "capture_format/frame/frame.h"
#include "passes/transparency/sample_blend.h"
#include "replay/session/drawn_by.h"

namespace strata::ui {

Result<std::vector<SampleFragments>> fragments_of(Session& session, Progress& progress, const PixelQuestion& question) {
    if (!progress.at(0, "the frame's transparent fragments, in double"))
        return fail(Fault::stopped, "session.stopped", "stopped");
    const auto lists = session.transparent_fragments(question.request);
    if (!lists) return lists.error();
    const glm::uvec2 at = question.pixel;
    if (at.x >= (*lists)->width() || at.y >= (*lists)->height())
        return fail(Fault::usage, "frame.no_pixel", "the frame is {width} x {height}; there is no pixel {x}, {y}",
                    (*lists)->width(), (*lists)->height(), at.x, at.y);
    std::vector<SampleFragments> samples((*lists)->samples());
    for (std::uint32_t sample = 0; sample < samples.size(); ++sample) {
        SampleFragments& made = samples[sample];
        made.undecided = (*lists)->undecided(at.x, at.y, sample);
        for (const Fragment& fragment : transparency::nearest_first((*lists)->at(at.x, at.y, sample))) {
            made.fragments.push_back({fragment, made.through, {}});
            made.light += made.through * (fragment.color + fragment.emission);
            made.through *= fragment.transmittance;
        }
    }
    // The lists are the session's and go with its next call.
    const auto frame = session.frame(question.request.variant.frame);
    if (!frame) return frame.error();
    for (SampleFragments& sample : samples)
        for (PixelFragment& fragment : sample.fragments) fragment.drawn_by = drawn_by(*frame, fragment.fragment.submission);
    return samples;
}

}  // namespace strata::ui
