#include "ui/report/report_job.h"

namespace strata::ui {

JobOf<Study> start_report(Replayer& replayer, const ReportRequest& wanted, std::string capture_name) {
    return replayer.start<Study>(
        [wanted, capture_name = std::move(capture_name)](Session& session, Progress& progress) -> Result<Study> {
            auto report =
                make_report(session, wanted, [&](std::string_view what, double done) { progress.at(done, std::string(what)); });
            if (!report) return report.error();
            if (!report->stopped.empty()) return fail(Fault::stopped, "session.stopped", "{progress}", report->stopped);
            report->capture_name = capture_name;
            Study study{wanted.base, *std::move(report), {}};
            study.columns = columns_of(study.report);
            return study;
        },
        Yields::between_steps);
}

JobOf<Study> start_modeling(Replayer& replayer, Study study, const GpuModel& model, std::filesystem::path program) {
    return replayer.start<Study>(
        [study = std::move(study), &model, program = std::move(program)](Session& session, Progress& progress) -> Result<Study> {
            auto costs = model_costs(session, {study.report, study.base, &model, program},
                                     [&](std::string_view what, double done) { progress.at(done, std::string(what)); });
            if (!costs) return costs.error();
            Study more = study;
            std::erase_if(more.columns, [&](const ReportColumn& column) { return column.label == costs->column.label; });
            more.missing[costs->column.label] = std::move(costs->missing);
            more.columns.push_back(std::move(costs->column));
            return more;
        },
        Yields::between_steps);
}

}  // namespace strata::ui
