#include "ui/report_job.h"

#include <algorithm>

namespace strata::ui {
namespace {

constexpr const char* this_program = "/proc/self/exe";

/// Stops a session with a job, but not for pictures that are made between two steps of the job.
class StoppedSession {
public:
    StoppedSession(Session& session, Progress& progress, std::stop_source stop)
        : session_(&session), progress_(&progress), stop_(std::move(stop)) {
        session_->stop_when(stop_.get_token());
    }
    StoppedSession(const StoppedSession&) = delete;
    StoppedSession& operator=(const StoppedSession&) = delete;
    ~StoppedSession() { session_->stop_when({}); }

    void tell(std::string_view what, double done) {
        session_->stop_when({});
        if (!progress_->at(done, std::string(what))) stop_.request_stop();
        session_->stop_when(stop_.get_token());
    }

private:
    Session* session_;
    Progress* progress_;
    std::stop_source stop_;
};

}  // namespace

JobOf<Study> start_report(Replayer& replayer, const ReportRequest& wanted, std::string capture_name, std::stop_source stop) {
    return replayer.start<Study>([wanted, capture_name = std::move(capture_name), stop = std::move(stop)](
                                     Session& session, Progress& progress) -> Result<Study> {
        StoppedSession stopped(session, progress, stop);
        auto report = make_report(session, wanted, [&](std::string_view what, double done) { stopped.tell(what, done); });
        if (!report) return report.error();
        report->capture_name = capture_name;
        Study study{wanted.base, *std::move(report), {}};
        study.columns = columns_of(study.report);
        return study;
    });
}

JobOf<Study> start_modelling(Replayer& replayer, Study study, const GpuModel& model, std::stop_source stop) {
    return replayer.start<Study>(
        [study = std::move(study), &model, stop = std::move(stop)](Session& session, Progress& progress) -> Result<Study> {
            StoppedSession stopped(session, progress, stop);
            auto costs = model_costs(session, {study.report, study.base, &model, this_program},
                                     [&](std::string_view what, double done) { stopped.tell(what, done); });
            if (!costs) return costs.error();
            Study more = study;
            std::erase_if(more.columns, [&](const ReportColumn& column) { return column.label == costs->column.label; });
            more.missing[costs->column.label] = std::move(costs->missing);
            more.columns.push_back(std::move(costs->column));
            return more;
        });
}

}  // namespace strata::ui
