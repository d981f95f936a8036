// The session on a thread of its own. Panels say what they want to see, look at the last good result in the meantime, and never
// wait. Of several wishes for one picture the latest wins.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "capture_format/frame/frame.h"
#include "replay/session/session.h"
#include "ui/replayer/work_queue.h"

namespace strata::ui {

/// What is known of a capture once it is open.
struct CaptureFacts {
    DeviceInfo device;
    std::size_t frames = 0;
    std::string id;
    std::vector<std::string> left_out;  ///< of the file, each with where it is
};

/// What is known of a frame without replaying it.
struct FrameFacts {
    std::size_t index = 0;
    Frame bare;  ///< the view and the recorded choices alone
    Features features;
};

/// A step of the whole plan, whatever the memo saved of it.
struct PlanRow {
    Scope scope;
    std::string name;                 ///< as in StepRecord
    std::vector<std::string> images;  ///< that it writes, by their names in the graph
    std::size_t barriers = 0;
    std::string work = {}, short_work = {};  ///< see step_work.h
    std::size_t draws = 0;
    std::uint64_t made_bytes = 0;   ///< of the plan's own images and buffers that it is the first to use
    std::uint64_t alive_bytes = 0;  ///< of all that are alive when it runs
};

/// The same frame whatever is brought back of it.
inline Request without_outputs(Request request) {
    request.outputs.clear();
    return request;
}

/// What pictures and numbers are made of: what was replayed, whatever was brought back of it, and with which shaders.
struct MadeOf {
    Request request = {};       ///< without outputs
    std::uint64_t shaders = 0;  ///< see Replayer::shaders()
    friend bool operator==(const MadeOf&, const MadeOf&) = default;
};

/// What a request gave.
struct Replay {
    Request request;
    std::uint64_t shaders = 0;  ///< see Replayer::shaders()
    /// The same number as that of the replay before in its place where only images are added or left out: then `run` still says
    /// what the last change executed.
    std::uint64_t change = 0;
    FrameFacts frame;
    Run run;
    std::vector<PlanRow> steps;
    std::vector<SkippedStage> skipped;
    std::vector<CulledStep> culled;
    double ms = 0;  ///< that it took, all in all
    MadeOf made_of() const { return {without_outputs(request), shaders}; }
    /// One of the images asked for; null where the frame does not have it. Keeps the replay alive.
    std::shared_ptr<const HostImage> image(const std::shared_ptr<const Replay>& self, const std::string& name) const;
};

/// How a job makes room for a picture that is wished for meanwhile.
enum class Yields {
    at_once,        ///< what it is in is stopped; after the picture it begins anew
    between_steps,  ///< the picture waits for the next Progress::at(): for what takes minutes and says so often how far it is
};

/// On a CPU driver both sides draw on the same cores: the calling thread gives way to the window's, and so do the threads that a
/// driver makes for what this thread opens.
void let_the_window_go_first();

class Replayer {
public:
    using Open = std::function<Result<std::unique_ptr<Session>>()>;
    /// Opens on its thread, too; and again where a device was lost.
    explicit Replayer(Open);
    /// Stops what is being computed.
    ~Replayer();

    /// Wishes for a picture in a place of that name ("A", "B"). Cheap when it is what was wished last.
    void show(const std::string& place, const Request&);
    /// Other shaders are being compiled: until they are in use or refused nothing that is shown counts as up to date.
    void await_shaders() { awaits_shaders_ = true; }
    /// The session uses other shaders: every wish anew.
    void take_shaders();
    /// The session uses the shaders that it used before.
    void keep_shaders() { awaits_shaders_ = false; }
    bool awaits_shaders() const { return awaits_shaders_; }
    /// How often other shaders came into use.
    std::uint64_t shaders() const { return shaders_; }
    /// What a replay of this request is made of, as things are now.
    MadeOf made_of(const Request& request) const { return {without_outputs(request), shaders_}; }
    /// The last good one of a place, as of the latest take_results(); null at first.
    std::shared_ptr<const Replay> shown(const std::string& place) const;
    /// Why the latest wish of a place has no picture.
    const Error* error(const std::string& place) const;
    /// Whether what is shown is what was wished for.
    bool is_current(const std::string& place) const;
    /// Whether what is shown was made of this request, whatever images either brings back, with the shaders in use.
    bool is_of(const std::string& place, const Request&) const;
    /// Whether something that was made before is what this request gives now.
    bool is_of(const MadeOf& made, const Request& request) const { return !awaits_shaders_ && made == made_of(request); }

    /// Null until the capture is open.
    const CaptureFacts* facts() const { return facts_ ? &*facts_ : nullptr; }
    const Error* open_error() const { return open_error_ ? &*open_error_ : nullptr; }

    /// Anything else a session can do. Cancelling stops what the session is in, too.
    template <typename T>
    JobOf<T> start(const std::function<Result<T>(Session&, Progress&)>& compute, Yields yields = Yields::at_once) {
        auto job = std::make_shared<Job<T>>(queue_);
        add(job, compute, yields);
        return job;
    }

    /// At the start of a frame: what was finished since becomes what is shown.
    void take_results();
    bool is_idle() const { return queue_.is_idle(); }

private:
    struct Slot {
        Request wished;
        std::shared_ptr<const Replay> good;
        std::optional<Error> error;
        std::uint64_t wish = 0, answered = 0;  ///< numbers of the latest and of the latest that was finished
    };
    struct Wish {
        std::uint64_t number = 0, shaders = 0;
        Request request;
    };
    struct Answer {
        std::string place;
        std::uint64_t wish = 0;
        Result<std::shared_ptr<const Replay>> replay;
    };

    template <typename T>
    void add(const JobOf<T>& job, const std::function<Result<T>(Session&, Progress&)>& compute, Yields yields) {
        queue_.add([this, job, compute, yields] {
            if (job->progress.is_cancelled()) return;
            const auto session = begin(job->progress, yields);
            if (!session) return job->finish(session.error());
            auto result = within_memory<T>([&] { return compute(**session, job->progress); });
            if (end(*session, job->progress, result ? nullptr : &result.error())) add(job, compute, yields);
            else job->finish(std::move(result));
        });
    }
    /// The session, held for as long as the job runs: a picture that is made in between may need a new one.
    Result<std::shared_ptr<Session>> begin(Progress&, Yields);
    /// Whether the job has to begin anew.
    bool end(const std::shared_ptr<Session>&, const Progress&, const Error*);

    void open();
    void wish(const std::string& place);
    Result<std::shared_ptr<const Replay>> answer(const std::string& place, const Wish&);
    void serve(const std::string& place);
    void serve_wish(const std::string& place);

    mutable std::mutex mutex_;
    std::map<std::string, Wish> wishes_;          ///< not begun
    std::vector<Answer> answers_;                 ///< not taken
    std::optional<Result<CaptureFacts>> opened_;  ///< not taken
    Progress* running_ = nullptr;                 ///< of the job that the session is in
    Yields yields_ = Yields::at_once;             ///< that job
    std::stop_source closing_;

    std::map<std::string, Slot> places_;  // the window's
    std::optional<CaptureFacts> facts_;
    std::optional<Error> open_error_;
    std::uint64_t shaders_ = 0;
    bool awaits_shaders_ = false;

    Open open_;  // the thread's, and what follows
    std::shared_ptr<Session> session_;
    std::optional<FrameFacts> frame_;
    std::map<std::string, std::shared_ptr<const Replay>> latest_;  ///< by place
    WorkQueue queue_;                                              // last: it uses all of the above
};

}  // namespace strata::ui
