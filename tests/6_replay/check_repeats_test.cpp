// What varies is found and named. Our techniques do not vary, so a session that does stands between.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "passes/frame_images.h"
#include "replay/cli/repeat.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// One image of one pass, or its first image.
struct FlippedBit {
    std::string pass, image;
};

/// Another session, of which one bit of one image flips in one run.
class Flickering final : public Session {
public:
    Flickering(Session& steady, FlippedBit flip, std::size_t run) : steady_(&steady), flip_(std::move(flip)), flips_at_(run) {}

    /// Gives back this run from here on instead of replaying: a loop over all images then costs nothing.
    void repeat(const Run& recorded) { recorded_ = &recorded; }

    const DeviceInfo& device() const override { return steady_->device(); }
    const Capture* capture() const override { return steady_->capture(); }
    std::size_t frame_count() const override { return steady_->frame_count(); }
    Result<Frame> frame(std::size_t i) override { return steady_->frame(i); }
    Result<Run> run(const Request& request) override {
        auto run = recorded_ ? Result<Run>(*recorded_) : steady_->run(request);
        if (runs_++ != flips_at_) return run;
        for (PassImages& pass : run->passes) {
            if (pass.label != flip_.pass) continue;
            const auto image = flip_.image.empty() ? pass.images.begin() : pass.images.find(flip_.image);
            image->second.texels.back() ^= std::byte{1};
        }
        return run;
    }
    Result<std::vector<Run>> time(std::span<const Request> r, std::size_t n, const Progress& p) override {
        return steady_->time(r, n, p);
    }
    Result<Run> run_from(const Request& r, Stage s, const ImageSet& o) override { return steady_->run_from(r, s, o); }
    Result<PlannedFrame> plan(const Request& r) override { return steady_->plan(r); }
    Result<HostImage> peek(const Request& r, std::size_t s, const std::string& i) override { return steady_->peek(r, s, i); }
    Result<std::vector<StepImages>> step_images(const Request& r, Stage s) override { return steady_->step_images(r, s); }
    Result<std::vector<StepImages>> pixel_steps(const Request& r, glm::uvec2 p) override { return steady_->pixel_steps(r, p); }
    Result<std::vector<Cover>> draw_cover(const Request& r, std::uint32_t d) override { return steady_->draw_cover(r, d); }
    Result<ImageSet> stage_images(const Request& r, Stage s) override { return steady_->stage_images(r, s); }
    Result<ImageSet> truth(const Request& r, Stage s) override { return steady_->truth(r, s); }
    Result<Accuracy> judge(const Request& r, Stage s, Against a, const ImageSet* t) override {
        return steady_->judge(r, s, a, t);
    }
    Result<const FragmentLists*> transparent_fragments(const Request& r) override { return steady_->transparent_fragments(r); }
    Result<std::vector<Run>> run(Frame f, std::span<const Request> r) override { return steady_->run(std::move(f), r); }
    Result<ReloadedShaders> reload_shaders(const std::filesystem::path& f, std::span<const Request> r) override {
        return steady_->reload_shaders(f, r);
    }
    void stop_when(std::stop_token t) override { steady_->stop_when(std::move(t)); }
    void forget_memo() override { steady_->forget_memo(); }

private:
    Session* steady_;
    FlippedBit flip_;
    std::size_t flips_at_, runs_ = 0;
    const Run* recorded_ = nullptr;
};

Request with_passes() { return {.passes = Passes::read_back}; }

TEST(CheckRepeats, NamesTheFirstPassThatVariesAndWhereItRan) {
    const auto steady = scenario_session("three_panes");
    Flickering flickering(*steady, {"transparency", ""}, 3);
    const auto first = must(flickering.run(with_passes()));
    EXPECT_TRUE(check_repeats(flickering, with_passes(), first, 3));
    const auto checked = check_repeats(flickering, with_passes(), first, 5);
    ASSERT_THAT(checked, FailsWith("session.not_repeatable", Field("pass", "transparency"), Field("image", "color"),
                                   Field("differing", 1)));
    EXPECT_EQ(checked.error().fault, Fault::not_repeatable);
    for (const std::string& part : {steady->device().name, steady->device().driver, steady->device().cpu})
        EXPECT_THAT(checked, FailsWith("session.not_repeatable", Field("device", testing::HasSubstr(part))));
}

TEST(CheckRepeats, LooksAtEveryPassNotAtThePictureAlone) {
    const auto steady = scenario_session("three_panes");
    Flickering flickering(*steady, {"gbuffer", ""}, 1);  // nothing after it sees the flip
    const auto first = must(flickering.run(with_passes()));
    EXPECT_THAT(check_repeats(flickering, with_passes(), first, 2),
                FailsWith("session.not_repeatable", Field("pass", "gbuffer")));
}

TEST(CheckRepeats, LooksAtEveryImageOfEveryPassFromTheFirstToTheLast) {
    const auto steady = scenario_session("three_panes");
    const auto first = must(steady->run(with_passes()));
    ASSERT_GT(first.passes.size(), 3u);
    for (const PassImages& pass : first.passes)
        for (const auto& [name, image] : pass.images) {
            Flickering flickering(*steady, {pass.label, name}, 0);
            flickering.repeat(first);
            EXPECT_THAT(
                check_repeats(flickering, with_passes(), first, 2),
                FailsWith("session.not_repeatable", Field("pass", pass.label), Field("image", name), Field("differing", 1)));
        }
}

TEST(CheckRepeats, LooksAtTheLastRepeat) {
    const auto steady = scenario_session("three_panes");
    const auto first = must(steady->run(with_passes()));
    constexpr std::size_t repeats = 4;  // the run that is given and three more
    Flickering flickering(*steady, {"transparency", ""}, repeats - 2);
    flickering.repeat(first);
    EXPECT_THAT(check_repeats(flickering, with_passes(), first, repeats),
                FailsWith("session.not_repeatable", Field("repeat", repeats), Field("repeats", repeats)));
}

}  // namespace
}  // namespace strata
