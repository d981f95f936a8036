// What a panel asks the session again and again as what is pinned or chosen changes. The answer is computed on the session's
// thread; what nobody waits for any more is stopped, so that pictures need not wait for it either.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "ui/replayer/keyed.h"
#include "ui/replayer/replayer.h"

namespace strata::ui {

template <typename Question, typename Answer>
class LiveQuery {
public:
    using Compute = std::function<Result<Answer>(Session&, Progress&, const Question&)>;

    LiveQuery() = default;
    LiveQuery(const LiveQuery&) = delete;
    LiveQuery& operator=(const LiveQuery&) = delete;
    ~LiveQuery() { withdraw(); }

    /// Once per frame with what is to be known now; costs nothing while that stays the same. While the picture "A" is on its way
    /// the session is left to it.
    void ask(Replayer& replayer, const Question& question, const Compute& compute) {
        if (!replayer.is_current("A")) return withdraw();
        take();
        if (asked_ && asked_->first == question && asked_->second == replayer.shaders()) return;
        withdraw();
        asked_.emplace(question, replayer.shaders());
        error_.clear();
        job_ = replayer.start<Answer>(
            [question, compute](Session& session, Progress& progress) { return compute(session, progress, question); });
    }
    /// Stops what is being computed; the next ask() begins it anew.
    void withdraw() {
        take();
        if (!job_) return;
        drop();
        asked_.reset();
    }
    /// Stops what is being computed until something else is asked, or again().
    void stop() {
        if (!job_) return;
        drop();
        error_ = "stopped";
    }
    void again() { asked_.reset(); }

    /// Of the latest question that was answered well; null at first, and where the present one failed.
    const Answer* answer() const { return error_.empty() ? answer_.value() : nullptr; }
    const Question* answered() const { return answer() ? &answer_.key()->first : nullptr; }
    /// Whether that is the answer to this question, with the shaders in use.
    bool is_answered(const Replayer& replayer, const Question& question) const {
        return answered() && *answered() == question && has_shaders_of(replayer);
    }
    bool has_shaders_of(const Replayer& replayer) const {
        return !replayer.awaits_shaders() && answer() && answer_.key()->second == replayer.shaders();
    }
    /// A number that changes with every answer.
    std::size_t version() const { return version_; }
    const std::string& error() const { return error_; }
    /// Null while nothing is being computed.
    const Progress* progress() const { return job_ && !job_->result() ? &job_->progress : nullptr; }

private:
    void take() {
        if (!job_ || !job_->result()) return;
        const Result<Answer>& result = *job_->result();
        if (result) {
            answer_.set(*asked_, *result);
            ++version_;
        } else {
            error_ = result.error().sentence;
        }
        job_.reset();
    }
    void drop() {
        job_->progress.cancel();
        job_.reset();
    }

    using Key = std::pair<Question, std::uint64_t>;  ///< with Replayer::shaders()
    std::optional<Key> asked_;
    Keyed<Key, Answer> answer_;
    std::size_t version_ = 0;
    std::string error_;
    JobOf<Answer> job_;
};

}  // namespace strata::ui
