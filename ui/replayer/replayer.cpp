#include "ui/replayer/replayer.h"

#include <sys/resource.h>

#include <algorithm>

#include "replay/measure/host_timer.h"
#include "ui/frame/step_work.h"

namespace strata::ui {
namespace {

Result<FrameFacts> facts_of(Session& session, std::size_t index) {
    auto frame = session.frame(index);
    if (!frame) return frame.error();
    FrameFacts facts{.index = index, .features = frame_features(*frame)};
    facts.bare.view = frame->view;
    facts.bare.recorded_with = std::move(frame->recorded_with);
    return facts;
}

CaptureFacts facts_of(const Session& session) {
    CaptureFacts facts{.device = session.device(), .frames = session.frame_count(), .id = session.capture_id(), .left_out = {}};
    if (const Capture* capture = session.capture()) facts.left_out = capture->summary().left_out;
    return facts;
}

PlanRow row_of(const Plan& plan, const PlannedStep& planned) {
    PlanRow row{.scope = plan.scopes[planned.step.scope],
                .name = planned.step.name,
                .images = {},
                .barriers = planned.barriers.size(),
                .work = work_text(planned),
                .short_work = short_work(planned),
                .draws = draws_of(planned)};
    for (const Image image : images_written(planned.step)) row.images.push_back(plan.images[image.id].name);
    return row;
}

std::vector<PlanRow> rows_of(const Plan& plan) {
    std::vector<PlanRow> rows;
    for (const PlannedStep& step : plan.steps) rows.push_back(row_of(plan, step));
    for (const Life& life : lives_of(plan)) rows[life.first].made_bytes += life.bytes;
    const MemoryOverTime memory = memory_over_time(plan);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].alive_bytes = memory.alive[i];
    return rows;
}

/// A view or an image more of what is shown: the person changed nothing.
bool asks_for_more_images(const Request& request, const Replay* before) {
    return before && before->request != request && without_outputs(before->request) == without_outputs(request);
}

Result<std::shared_ptr<const Replay>> replay(Session& session, const Request& request, const FrameFacts& frame,
                                             const Replay* before) {
    HostTimer timer;
    auto planned = session.plan(request);
    if (!planned) return planned.error();
    auto run = session.run(request);
    if (!run) return run.error();
    auto made = std::make_shared<Replay>();
    made->request = request;
    made->frame = frame;
    made->run = *std::move(run);
    made->steps = rows_of(planned->plan);
    made->skipped = std::move(planned->skipped);
    made->culled = std::move(planned->plan.culled);
    made->ms = timer();
    if (asks_for_more_images(request, before)) {
        made->brings_back_more = true;
        made->run.steps = before->run.steps;
        made->run.acts_executed = before->run.acts_executed;
        made->run.acts_from_memo = before->run.acts_from_memo;
    }
    return std::shared_ptr<const Replay>(std::move(made));
}

/// On a CPU driver both sides draw on the same cores. The driver's threads, which opening makes, have their maker's priority.
void let_the_window_go_first() {
    constexpr int niceness = 10;
    setpriority(PRIO_PROCESS, 0, niceness);  // of a thread, on Linux
}

}  // namespace

std::shared_ptr<const HostImage> Replay::image(const std::shared_ptr<const Replay>& self, const std::string& name) const {
    const auto found = run.images.find(name);
    return found == run.images.end() ? nullptr : std::shared_ptr<const HostImage>(self, &found->second);
}

Replayer::Replayer(Open open) : open_(std::move(open)) {
    queue_.add_first([this] {
        let_the_window_go_first();
        this->open();
    });
}

Replayer::~Replayer() {
    closing_.request_stop();
    const std::scoped_lock lock(mutex_);
    if (running_) running_->cancel();
}

void Replayer::open() {
    session_ = nullptr;  // its memory may be what the next one needs
    auto session = within_memory<std::unique_ptr<Session>>(open_);
    Result<CaptureFacts> facts = session ? Result<CaptureFacts>(facts_of(**session)) : Result<CaptureFacts>(session.error());
    if (session) session_ = *std::move(session);
    const std::scoped_lock lock(mutex_);
    opened_ = std::move(facts);
}

Result<std::shared_ptr<Session>> Replayer::begin(Progress& progress, Yields yields) {
    if (closing_.stop_requested()) return fail(Fault::stopped, "the inspector is being closed");
    if (!session_) return fail(Fault::bad_input, "no capture is open");
    progress.resume();
    session_->stop_when(progress.token());
    const std::scoped_lock lock(mutex_);
    running_ = &progress;
    yields_ = yields;
    return session_;
}

bool Replayer::end(const std::shared_ptr<Session>& session, const Progress& progress, const Error* error) {
    {
        const std::scoped_lock lock(mutex_);
        running_ = nullptr;
    }
    session->stop_when({});
    if (!error || progress.is_cancelled() || closing_.stop_requested()) return false;
    if (progress.is_interrupted() || error->fault == Fault::stopped || session != session_) return true;
    // A lost device stays lost: the next job or wish gets a new one.
    if (error->fault == Fault::device_failed) open();
    return false;
}

void Replayer::show(const std::string& place, const Request& request) {
    Slot& known = places_[place];
    if (known.wish > 0 && known.wished == request) return;
    known.wished = request;
    wish(place);
}

void Replayer::show_again() {
    for (const auto& [place, known] : places_) wish(place);
}

void Replayer::wish(const std::string& place) {
    Slot& known = places_.at(place);
    ++known.wish;
    {
        const std::scoped_lock lock(mutex_);
        wishes_[place] = {known.wish, known.wished};
    }
    queue_.add_first([this, place] { serve(place); });
    const std::scoped_lock lock(mutex_);
    if (running_ && yields_ == Yields::at_once) running_->interrupt();
}

/// Between two steps of a job, too, whose token would stop the picture with it.
void Replayer::serve(const std::string& place) {
    if (session_) session_->stop_when(closing_.get_token());
    serve_wish(place);
    if (session_ && running_) session_->stop_when(running_->token());
}

void Replayer::serve_wish(const std::string& place) {
    std::pair<std::uint64_t, Request> wish;
    {
        const std::scoped_lock lock(mutex_);
        const auto waiting = wishes_.find(place);
        if (waiting == wishes_.end()) return;  // a later wish was served instead
        wish = std::move(waiting->second);
        wishes_.erase(waiting);
    }
    if (!session_) return;
    Answer given{place, wish.first, within_memory<std::shared_ptr<const Replay>>([&] { return answer(place, wish.second); })};
    // A lost device stays lost: the next wish gets a new one.
    if (!given.replay && given.replay.error().fault == Fault::device_failed) open();
    const std::scoped_lock lock(mutex_);
    answers_.push_back(std::move(given));
}

Result<std::shared_ptr<const Replay>> Replayer::answer(const std::string& place, const Request& request) {
    if (!frame_ || frame_->index != request.variant.frame) {
        auto facts = facts_of(*session_, request.variant.frame);
        if (!facts) return facts.error();
        frame_ = *std::move(facts);
    }
    std::shared_ptr<const Replay>& latest = latest_[place];
    auto made = replay(*session_, request, *frame_, latest.get());
    if (made) latest = *made;
    return made;
}

void Replayer::take_results() {
    const std::scoped_lock lock(mutex_);
    if (opened_) {
        if (*opened_) facts_ = **opened_;
        else open_error_ = opened_->error();
        opened_.reset();
    }
    for (Answer& answer : answers_) {
        Slot& place = places_[answer.place];
        place.answered = answer.wish;
        place.error.reset();
        if (answer.replay) place.good = *std::move(answer.replay);
        else place.error = answer.replay.error();
    }
    answers_.clear();
}

std::shared_ptr<const Replay> Replayer::shown(const std::string& place) const {
    const auto known = places_.find(place);
    return known == places_.end() ? nullptr : known->second.good;
}

const Error* Replayer::error(const std::string& place) const {
    const auto known = places_.find(place);
    return known == places_.end() || !known->second.error ? nullptr : &*known->second.error;
}

bool Replayer::is_of(const std::string& place, const Request& request) const {
    const auto replay = shown(place);
    return replay && without_outputs(replay->request) == without_outputs(request);
}

bool Replayer::is_current(const std::string& place) const {
    const auto known = places_.find(place);
    return known != places_.end() && known->second.wish > 0 && known->second.answered == known->second.wish;
}

}  // namespace strata::ui
