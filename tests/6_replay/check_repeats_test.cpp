// What varies is found and named. Our techniques do not vary, so a session that does stands between.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "replay/session/repeat.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// One image of one act, or its first image.
struct FlippedBit {
    std::string act, image;
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
        for (ActImages& act : run->acts) {
            if (act.label != flip_.act) continue;
            const auto image = flip_.image.empty() ? act.images.begin() : act.images.find(flip_.image);
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

Request with_acts() { return {.acts = Acts::brought_back}; }

TEST(CheckRepeats, NamesTheFirstActThatVariesAndWhereItRan) {
    const auto steady = scenario_session("three_panes");
    Flickering flickering(*steady, {"transparency", ""}, 3);
    const auto first = must(flickering.run(with_acts()));
    EXPECT_TRUE(check_repeats(flickering, with_acts(), first, 3));
    const auto checked = check_repeats(flickering, with_acts(), first, 5);
    ASSERT_FALSE(checked);
    EXPECT_EQ(checked.error().fault, Fault::not_repeatable);
    EXPECT_THAT(checked.error().sentence, testing::HasSubstr("transparency is the first pass that varies: 'color' in 1 of "));
    for (const std::string& part : {steady->device().name, steady->device().driver, steady->device().cpu})
        EXPECT_THAT(checked.error().sentence, testing::HasSubstr(part));
}

TEST(CheckRepeats, LooksAtEveryActNotAtThePictureAlone) {
    const auto steady = scenario_session("three_panes");
    Flickering flickering(*steady, {"gbuffer", ""}, 1);  // nothing after it sees the flip
    const auto first = must(flickering.run(with_acts()));
    const auto checked = check_repeats(flickering, with_acts(), first, 2);
    ASSERT_FALSE(checked);
    EXPECT_THAT(checked.error().sentence, testing::HasSubstr("gbuffer is the first pass that varies"));
}

TEST(CheckRepeats, LooksAtEveryImageOfEveryActFromTheFirstToTheLast) {
    const auto steady = scenario_session("three_panes");
    const auto first = must(steady->run(with_acts()));
    ASSERT_GT(first.acts.size(), 3u);
    for (const ActImages& act : first.acts)
        for (const auto& [name, image] : act.images) {
            Flickering flickering(*steady, {act.label, name}, 0);
            flickering.repeat(first);
            const auto checked = check_repeats(flickering, with_acts(), first, 2);
            ASSERT_FALSE(checked) << act.label << " " << name;
            EXPECT_THAT(checked.error().sentence,
                        testing::HasSubstr(fmt::format("{} is the first pass that varies: '{}' in 1 of", act.label, name)));
        }
}

TEST(CheckRepeats, LooksAtTheLastRepeat) {
    const auto steady = scenario_session("three_panes");
    const auto first = must(steady->run(with_acts()));
    constexpr std::size_t repeats = 4;  // the run that is given and three more
    Flickering flickering(*steady, {"transparency", ""}, repeats - 2);
    flickering.repeat(first);
    const auto checked = check_repeats(flickering, with_acts(), first, repeats);
    ASSERT_FALSE(checked);
    EXPECT_THAT(checked.error().sentence, testing::HasSubstr("repeat 4 of 4"));
}

}  // namespace
}  // namespace strata
