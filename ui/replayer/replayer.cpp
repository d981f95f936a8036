#include "ui/replayer/replayer.h"

#include <sys/resource.h>

#include <algorithm>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/stage_choice.h"
#include "capture_format/reader.h"
#include "passes/frame_images.h"
#include "passes/scene/scene_facts.h"
#include "replay/gpu/host_timer.h"
#include "ui/replayer/step_work.h"

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

/// Images are added or left out of what is shown: the person changed nothing.
bool asks_for_other_images(const Replay& now, const Replay& before) {
    return before.request.outputs != now.request.outputs && before.made_of() == now.made_of();
}

/// What the last change executed, and the steps that only the images asked for now have brought into the plan.
void say_what_the_last_change_executed(Replay& now, const Replay& before) {
    const auto was_planned = [&](const StepRecord& step) {
        return std::ranges::find(before.steps, step.scope, &PlanRow::scope) != before.steps.end();
    };
    std::erase_if(now.run.steps, was_planned);
    now.run.steps.insert(now.run.steps.begin(), before.run.steps.begin(), before.run.steps.end());
    now.run.passes_executed = before.run.passes_executed;
    now.run.passes_from_memo = before.run.passes_from_memo;
}

Result<std::shared_ptr<Replay>> replay(Session& session, const Request& request, const FrameFacts& frame) {
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
    return made;
}

}  // namespace

void let_the_window_go_first() {
    constexpr int niceness = 10;
    setpriority(PRIO_PROCESS, 0, niceness);  // of a thread, on Linux
}

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
    if (closing_.stop_requested()) return fail(Fault::stopped, "session.stopped", "the inspector is being closed");
    if (!session_) return fail(Fault::bad_input, "inspector.no_capture", "no capture is open");
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

void Replayer::take_shaders() {
    ++shaders_;
    awaits_shaders_ = false;
    for (const auto& [place, known] : places_) wish(place);
}

void Replayer::wish(const std::string& place) {
    Slot& known = places_.at(place);
    ++known.wish;
    {
        const std::scoped_lock lock(mutex_);
        wishes_[place] = {known.wish, shaders_, known.wished};
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
    Wish wish;
    {
        const std::scoped_lock lock(mutex_);
        const auto waiting = wishes_.find(place);
        if (waiting == wishes_.end()) return;  // a later wish was served instead
        wish = std::move(waiting->second);
        wishes_.erase(waiting);
    }
    if (!session_) return;
    Answer given{place, wish.number, within_memory<std::shared_ptr<const Replay>>([&] { return answer(place, wish); })};
    // A lost device stays lost: the next wish gets a new one.
    if (!given.replay && given.replay.error().fault == Fault::device_failed) open();
    const std::scoped_lock lock(mutex_);
    answers_.push_back(std::move(given));
}

Result<std::shared_ptr<const Replay>> Replayer::answer(const std::string& place, const Wish& wish) {
    if (!frame_ || frame_->index != wish.request.variant.frame) {
        auto facts = facts_of(*session_, wish.request.variant.frame);
        if (!facts) return facts.error();
        frame_ = *std::move(facts);
    }
    const auto made = replay(*session_, wish.request, *frame_);
    if (!made) return made.error();
    Replay& now = **made;
    now.shaders = wish.shaders;
    std::shared_ptr<const Replay>& latest = latest_[place];
    now.change = latest ? latest->change : 0;
    if (latest && asks_for_other_images(now, *latest)) say_what_the_last_change_executed(now, *latest);
    else ++now.change;
    latest = *made;
    return latest;
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
    return replay && is_of(replay->made_of(), request);
}

bool Replayer::is_current(const std::string& place) const {
    const auto known = places_.find(place);
    return known != places_.end() && known->second.wish > 0 && known->second.answered == known->second.wish;
}

}  // namespace strata::ui
