// What varies is found and named. Our techniques do not vary, so a session that does stands between.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "replay/repeat.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// Another session, of which one bit of one act flips in one run.
class Flickering final : public Session {
public:
    Flickering(Session& steady, std::string act, std::size_t run) : steady_(&steady), act_(std::move(act)), flips_at_(run) {}

    const DeviceInfo& device() const override { return steady_->device(); }
    const Capture* capture() const override { return steady_->capture(); }
    std::size_t frame_count() const override { return steady_->frame_count(); }
    Result<Frame> frame(std::size_t i) override { return steady_->frame(i); }
    Result<Run> run(const Request& request) override {
        auto run = steady_->run(request);
        if (runs_++ != flips_at_) return run;
        for (ActImages& act : run->acts)
            if (act.label == act_) act.images.begin()->second.texels[100] ^= std::byte{1};
        return run;
    }
    Result<std::vector<Run>> time(std::span<const Request> r, std::size_t n, const Progress& p) override {
        return steady_->time(r, n, p);
    }
    Result<PlannedFrame> plan(const Request& r) override { return steady_->plan(r); }
    Result<HostImage> peek(const Request& r, std::size_t s, const std::string& i) override { return steady_->peek(r, s, i); }
    Result<std::vector<StepImages>> step_images(const Request& r, Stage s) override { return steady_->step_images(r, s); }
    Result<std::vector<StepImages>> pixel_steps(const Request& r, glm::uvec2 p) override { return steady_->pixel_steps(r, p); }
    Result<std::vector<Cover>> draw_cover(const Request& r, std::uint32_t d) override { return steady_->draw_cover(r, d); }
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
    std::string act_;
    std::size_t flips_at_, runs_ = 0;
};

Request with_acts() { return {.acts = Acts::brought_back}; }

TEST(CheckRepeats, NamesTheFirstActThatVariesAndWhereItRan) {
    const auto steady = scenario_session("three_panes");
    Flickering flickering(*steady, "transparency", 3);
    const auto first = must(flickering.run(with_acts()));
    EXPECT_TRUE(check_repeats(flickering, with_acts(), first, 3));
    const auto checked = check_repeats(flickering, with_acts(), first, 5);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().fault, Fault::not_repeatable);
    EXPECT_THAT(checked.error().sentence, testing::HasSubstr("transparency is the first act that varies: 'color' in 1 of "));
    for (const std::string& part : {steady->device().name, steady->device().driver, steady->device().cpu})
        EXPECT_THAT(checked.error().sentence, testing::HasSubstr(part));
}

TEST(CheckRepeats, LooksAtEveryActNotAtThePictureAlone) {
    const auto steady = scenario_session("three_panes");
    Flickering flickering(*steady, "gbuffer", 1);  // nothing after it sees the flip
    const auto first = must(flickering.run(with_acts()));
    const auto checked = check_repeats(flickering, with_acts(), first, 2);
    ASSERT_FALSE(checked);
    EXPECT_THAT(checked.error().sentence, testing::HasSubstr("gbuffer is the first act that varies"));
}

}  // namespace
}  // namespace strata
